"""Right atrium: a chamber with a volume, filled by the systemic veins."""

from dataclasses import dataclass

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Chamber, mechanism
from heartfit.roles.chamber import Atrium


@mechanism
@dataclass(frozen=True)
class RightAtrium(Chamber):
    r"""Volume V of the right atrium, which determines its pressure in the place of a prescribed one.

    .. math:: \dot V = \frac{P_{sv} - P}{R_{sv}} - q_{tr} - \ldots, \qquad
              P = E_0 V_s \big( e^{(x - V_0)/V_s} - 1 \big) + e(t) E_{act} (x - V_0), \qquad
              x = V + \kappa (V_{rv} - V_{ref})

    The law is that of :class:`~heartfit.mechanisms.left_atrium.LeftAtrium`, softer and filled from systemic veins; with
    an elastance :math:`E_{sv} > 0` these are filled by the systemic arteries. The circuit is closed if the veins of
    both atria have an elastance. Without resistance, R_sv = 0, the pressure is prescribed.
    Sources: as the left one; Maceira et al., J Cardiovasc Magn Reson 2013, 15:29, for volumes. The values are ours: the
    standard heart has a mean pressure of 510 Pa (3.8 mmHg) and 35 to 60 mL.
    """

    compartment = "right_atrium"
    resistance: float = parameter(
        2e6, unit="Pa.s/m^3", symbol="R_{sv}", meaning="resistance of the systemic veins", sd=0.7, off=0.0
    )
    reservoir: float = parameter(
        700.0, unit="Pa", symbol="P_{sv}", meaning="pressure of the systemic veins at the start", sd=0.25
    )
    unstressed: float = parameter(
        20e-6, unit="m^3", symbol="V_{0,ra}", meaning="unstressed volume of the right atrium", sd=0.4
    )
    passive: float = parameter(
        1.2e7, unit="Pa/m^3", symbol="E_{0,ra}", meaning="passive elastance at the unstressed volume", sd=0.5
    )
    scale: float = parameter(
        60e-6,
        unit="m^3",
        symbol="V_{s,ra}",
        meaning="volume over which the passive elastance grows e-fold",
        sd=0.5,
    )
    active: float = parameter(
        1.2e7, unit="Pa/m^3", symbol="E_{act,ra}", meaning="active elastance at the peak of the kick", sd=0.6
    )
    descent: float = parameter(
        0.0, unit="1", symbol=r"\kappa_{ra}", meaning="share of the descent of the tricuspid valve plane"
    )
    ventricle: float = parameter(
        1e-4, unit="m^3", symbol="V_{ref,rv}", meaning="right ventricular volume without descent"
    )
    veins: float = parameter(
        0.0,
        unit="Pa/m^3",
        symbol="E_{sv}",
        meaning="elastance of the systemic veins; 0 stands for a reservoir of constant pressure",
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def atrium(self) -> Atrium:
        wall = self.unstressed, self.passive, self.scale, self.active
        return Atrium(*wall, self.descent, self.ventricle, self.resistance, self.reservoir, self.veins)

"""Left atrium: a chamber with a volume, filled by the pulmonary veins."""

from dataclasses import dataclass

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Chamber, mechanism
from heartfit.roles.chamber import Atrium


@mechanism
@dataclass(frozen=True)
class LeftAtrium(Chamber):
    r"""Volume V of the left atrium, which determines its pressure in the place of a prescribed one.

    .. math:: \dot V = \frac{P_{pv} - P}{R_{pv}} - q_{mi} - \ldots, \qquad
              P = E_0 V_s \big( e^{(x - V_0)/V_s} - 1 \big) + e(t) E_{act} (x - V_0), \qquad
              x = V + \kappa (V_{lv} - V_{ref})

    The atrium is a reservoir while the mitral valve is closed, a conduit in early diastole and contracts with the
    atrial kick of the heart, whose shape e(t) is. :math:`\kappa` is the share of the ventricular volume that the
    descent of the valve plane hands over; its force on the ventricle is neglected. Veins of elastance
    :math:`E_{pv} > 0` are filled by the pulmonary arteries. Without resistance, R_pv = 0, there is no atrium apart
    from its veins: the pressure is prescribed as it is without this mechanism.
    Sources: Hoit, J Am Coll Cardiol 2014, 63:493, for the three functions; Pironet et al., PLoS One 2013, 8:e65146,
    for an atrium of variable elastance. The passive elastance is ours: the standard heart fills 32 to 59 mL.
    """

    compartment = "left_atrium"
    resistance: float = parameter(
        4e6, unit="Pa.s/m^3", symbol="R_{pv}", meaning="resistance of the pulmonary veins", sd=0.7, off=0.0
    )
    reservoir: float = parameter(
        1350.0, unit="Pa", symbol="P_{pv}", meaning="pressure of the pulmonary veins at the start", sd=0.25
    )
    unstressed: float = parameter(
        20e-6, unit="m^3", symbol="V_{0,la}", meaning="unstressed volume of the left atrium", sd=0.4
    )
    passive: float = parameter(
        2.4e7, unit="Pa/m^3", symbol="E_{0,la}", meaning="passive elastance at the unstressed volume", sd=0.5
    )
    scale: float = parameter(
        60e-6,
        unit="m^3",
        symbol="V_{s,la}",
        meaning="volume over which the passive elastance grows e-fold",
        sd=0.5,
    )
    active: float = parameter(
        2.5e7, unit="Pa/m^3", symbol="E_{act,la}", meaning="active elastance at the peak of the kick", sd=0.6
    )
    descent: float = parameter(
        0.0, unit="1", symbol=r"\kappa_{la}", meaning="share of the descent of the mitral valve plane"
    )
    ventricle: float = parameter(
        1e-4, unit="m^3", symbol="V_{ref,lv}", meaning="left ventricular volume without descent"
    )
    veins: float = parameter(
        0.0,
        unit="Pa/m^3",
        symbol="E_{pv}",
        meaning="elastance of the pulmonary veins; 0 stands for a reservoir of constant pressure",
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def atrium(self) -> Atrium:
        wall = self.unstressed, self.passive, self.scale, self.active
        return Atrium(*wall, self.descent, self.ventricle, self.resistance, self.reservoir, self.veins)

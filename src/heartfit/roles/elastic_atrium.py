"""Form that both atria share: their parameters, and the coefficients of their law."""

from dataclasses import dataclass
from math import inf

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles.chamber import Atrium
from heartfit.roles.interfaces import Chamber


@dataclass(frozen=True)
class ElasticAtrium(Chamber):
    r"""Volume V of an atrium, which determines its pressure in the place of a prescribed one.

    .. math:: \dot V = \frac{P_v - P}{R_v} - q - \ldots, \qquad
              P = E_0 V_s \big( e^{(x - V_0)/V_s} - 1 \big) + e(t) E_{act} (x - V_0), \qquad
              x = V + \kappa (V_c - V_{ref})

    The atrium is a reservoir while its valve is closed, a conduit in early diastole and contracts with the atrial kick
    of the heart, whose shape e(t) is. :math:`\kappa` is the share of the volume of the ventricle, V_c, that the descent
    of the valve plane hands over; its force on the ventricle is neglected. Veins of elastance :math:`E_v > 0` are
    filled by the arteries of the other side. Without resistance, R_v = 0, there is no atrium apart from its veins: the
    pressure is prescribed as it is without this mechanism. A subclass names the ``compartment`` and declares values.
    Sources: Hoit, J Am Coll Cardiol 2014, 63:493, for the three functions; Pironet et al., PLoS One 2013, 8:e65146,
    for an atrium of variable elastance.
    """

    resistance: float = parameter(
        4e6, unit="Pa.s/m^3", symbol="R_v", meaning="resistance of the veins", sd=0.7, off=0.0
    )
    reservoir: float = parameter(
        1000.0, unit="Pa", symbol="P_v", meaning="pressure of the veins at the start", sd=0.25
    )
    unstressed: float = parameter(
        20e-6, unit="m^3", symbol="V_0", meaning="unstressed volume of the atrium", sd=0.4
    )
    passive: float = parameter(
        2e7, unit="Pa/m^3", symbol="E_0", meaning="passive elastance at the unstressed volume", sd=0.5
    )
    scale: float = parameter(
        60e-6,
        unit="m^3",
        symbol="V_s",
        meaning="volume over which the passive elastance grows e-fold",
        sd=0.5,
        high=inf,  # of a linear wall
    )
    active: float = parameter(
        2e7, unit="Pa/m^3", symbol="E_{act}", meaning="active elastance at the peak of the kick", sd=0.6
    )
    descent: float = parameter(
        0.0, unit="1", symbol=r"\kappa", meaning="share of the descent of the valve plane"
    )
    ventricle: float = parameter(
        1e-4, unit="m^3", symbol="V_{ref}", meaning="volume of the ventricle without descent"
    )
    veins: float = parameter(
        0.0,
        unit="Pa/m^3",
        symbol="E_v",
        meaning="elastance of the veins; 0 stands for a reservoir of constant pressure",
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def atrium(self) -> Atrium:
        wall = self.unstressed, self.passive, self.scale, self.active
        return Atrium(*wall, self.descent, self.ventricle, self.resistance, self.reservoir, self.veins)

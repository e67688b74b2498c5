"""Form that the dynamics of the four valves share: their parameters, inertance, loss and rates."""

from dataclasses import dataclass

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles.interfaces import Dynamics
from heartfit.roles.laws import BLOOD_DENSITY, Leaflets


@dataclass(frozen=True)
class ValveDynamics(Dynamics):
    r"""Inertance and opening :math:`\zeta` of a valve, scaled together by the slowness s.

    .. math:: q = \zeta f(\Delta p - L \dot q), \qquad L = s \frac{\rho l}{A}, \qquad
        \Delta p_f = \frac{q}{K} + s \frac{\rho}{2 A^2} q^2, \qquad
        \dot\zeta = \begin{cases} \frac{K_o}{s} (1 - \zeta) \Delta p & \Delta p > 0 \\
                                  \frac{K_c}{s} \zeta \Delta p & \Delta p < 0 \end{cases}

    with f the forward law of the valve, of conductance K, plus the pressure that gives the blood its speed. s = 0 is
    a valve without inertia that opens and closes at once. A subclass names the ``valve`` and declares its values; the
    values here are round ones. K_o and K_c of 0.01 cm^2/(dyn s) are 0.1 1/(Pa s).
    Source: Mynard et al., Int J Numer Meth Biomed Eng 2012, 28:626.
    """

    slowness: float = parameter(
        1.0,
        unit="1",
        symbol="s",
        meaning="inertia of the blood in the valve and of its leaflets, over its normal value",
        sd=0.5,
        off=0.0,
    )
    length: float = parameter(
        0.02, unit="m", symbol="l", meaning="effective length of the blood column", sd=0.35
    )
    area: float = parameter(5e-4, unit="m^2", symbol="A", meaning="area of the blood column", sd=0.3)
    opening: float = parameter(
        0.2, unit="1/(Pa.s)", symbol="K_o", meaning="rate of opening per pressure drop", sd=0.7
    )
    closing: float = parameter(
        0.2, unit="1/(Pa.s)", symbol="K_c", meaning="rate of closing per pressure drop", sd=1.0
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def inverse_square(self) -> float:
        return self.slowness / self.area**2

    def leaflets(self) -> Leaflets:
        if self.slowness == 0.0:
            return Leaflets()
        inertance = self.slowness * BLOOD_DENSITY * self.length / self.area
        return Leaflets(inertance, self.opening / self.slowness, self.closing / self.slowness)

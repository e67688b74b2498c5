"""Mitral valve dynamics: inertia of the blood in the valve, and leaflets that take time to open and to close."""

from dataclasses import dataclass

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Dynamics, mechanism
from heartfit.roles.laws import BLOOD_DENSITY, Leaflets


@mechanism
@dataclass(frozen=True)
class MitralDynamics(Dynamics):
    r"""Inertance and opening :math:`\zeta` of the mitral valve, scaled together by the slowness s.

    .. math:: q = \zeta f(\Delta p - L \dot q), \qquad L = s \frac{\rho l}{A}, \qquad
        \Delta p_f = \frac{q}{K} + s \frac{\rho}{2 A^2} q^2, \qquad
        \dot\zeta = \begin{cases} \frac{K_o}{s} (1 - \zeta) \Delta p & \Delta p > 0 \\
                                  \frac{K_c}{s} \zeta \Delta p & \Delta p < 0 \end{cases}

    with f the forward law of the valve, of conductance K, beside the pressure that gives the blood its speed. Inflow
    starts later, continues against an adverse pressure and partly flows back before the leaflets meet: the volume
    falls again in diastasis, and the atrial kick adds to it later. s = 0 is a valve without inertia that opens and
    closes at once.
    Sources: Mynard et al., Int J Numer Meth Biomed Eng 2012, 28:626, for the law; Thomas et al., Am J Physiol 1991,
    260:H1718, for the inertance of mitral inflow.
    """

    valve = "mitral"
    slowness: float = parameter(
        1.0,
        unit="1",
        symbol="s_{mi}",
        meaning="inertia of mitral inflow and of its leaflets, over its normal value",
        sd=0.5,
        off=0.0,
        scale=1.0,
    )
    length: float = parameter(
        0.036, unit="m", symbol="l_{mi}", meaning="effective length of the blood column", sd=0.35
    )
    area: float = parameter(4.5e-4, unit="m^2", symbol="A_{mi}", meaning="area of the blood column", sd=0.3)
    opening: float = parameter(
        0.3, unit="1/(Pa.s)", symbol="K_{o,mi}", meaning="rate of opening per pressure drop", sd=0.7
    )
    closing: float = parameter(
        0.05, unit="1/(Pa.s)", symbol="K_{c,mi}", meaning="rate of closing per pressure drop", sd=1.0
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

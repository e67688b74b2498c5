"""Mitral stenosis: a valve that opens too little and hinders filling."""

from dataclasses import dataclass

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Narrowing, mechanism
from heartfit.roles.laws import BLOOD_DENSITY

REFERENCE_FLOW = 2e-4
"""Flow [m^3/s] at which the gradient is stated: the mean of a normal filling."""


@mechanism
@dataclass(frozen=True)
class MitralStenosis(Narrowing):
    r"""Bernoulli's loss in series with the mitral valve, stated as the gradient G at a flow Q of 200 mL/s.

    .. math:: \Delta p = \Delta p_{valve} + G (q/Q)^2, \qquad G = \tfrac12 \rho\, Q^2 / A^2

    An effective orifice of A = 2 cm^2 (mild) has G = 0.5 kPa, one of 1.5 cm^2 (moderate from here) 0.94 kPa, one of
    1 cm^2 (severe from here) 2.1 kPa: two scales are moderate. The atrium keeps its pressure, so a ventricle
    that relaxes fast sucks; in a patient the atrial pressure rises instead.
    Source: Baumgartner et al., JASE 2009, 22:1.
    """

    valve = "mitral"
    gradient: float = parameter(
        250.0,
        unit="Pa",
        symbol="G_{mi}",
        meaning="pressure that the narrowing takes at 200 mL/s",
        sd=0.5,
        off=0.0,
        scale=500.0,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def inverse_square(self) -> float:
        return 2.0 * self.gradient / (BLOOD_DENSITY * REFERENCE_FLOW**2)

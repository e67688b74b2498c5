"""Aortic stenosis: a valve that opens too little and loses pressure."""

from dataclasses import dataclass

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Narrowing, mechanism
from heartfit.roles.laws import BLOOD_DENSITY

REFERENCE_FLOW = 4e-4
"""Flow [m^3/s] at which the gradient is stated: the peak of a normal ejection."""


@mechanism
@dataclass(frozen=True)
class AorticStenosis(Narrowing):
    r"""Bernoulli's loss in series with the aortic valve, stated as the gradient G at a flow Q of 400 mL/s.

    .. math:: \Delta p = \Delta p_{valve} + G (q/Q)^2, \qquad G = \tfrac12 \rho\, Q^2 / A^2

    An effective orifice of A = 1.5 cm^2 (mild from here) has G = 3.8 kPa, one of 1 cm^2 (severe from here) 8.5 kPa.
    Source: Baumgartner et al., JASE 2017, 30:372.
    """

    valve = "aortic"
    gradient: float = parameter(
        4000.0,
        unit="Pa",
        symbol="G_{ao}",
        meaning="pressure that the narrowing takes at 400 mL/s",
        sd=0.5,
        off=0.0,
        scale=4000.0,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def inverse_square(self) -> float:
        return 2.0 * self.gradient / (BLOOD_DENSITY * REFERENCE_FLOW**2)

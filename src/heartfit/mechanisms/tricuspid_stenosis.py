"""Tricuspid stenosis: a valve that opens too little and hinders filling."""

from dataclasses import dataclass

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Narrowing, mechanism
from heartfit.roles.laws import BLOOD_DENSITY

REFERENCE_FLOW = 2e-4
"""Flow [m^3/s] at which the gradient is stated: the mean of a normal filling."""


@mechanism
@dataclass(frozen=True)
class TricuspidStenosis(Narrowing):
    r"""Bernoulli's loss in series with the tricuspid valve, stated as the gradient G at a flow Q of 200 mL/s.

    .. math:: \Delta p = \Delta p_{valve} + G (q/Q)^2, \qquad G = \tfrac12 \rho\, Q^2 / A^2

    A mean gradient of 0.67 kPa (5 mmHg) is significant. The atrium keeps its pressure, so a ventricle that relaxes fast
    sucks; in a patient the atrial pressure rises instead.
    Source: Baumgartner et al., JASE 2009, 22:1.
    """

    valve = "tricuspid"
    gradient: float = parameter(
        250.0,
        unit="Pa",
        symbol="G_{tri}",
        meaning="pressure that the narrowing takes at 200 mL/s",
        sd=0.5,
        off=0.0,
        scale=250.0,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def inverse_square(self) -> float:
        return 2.0 * self.gradient / (BLOOD_DENSITY * REFERENCE_FLOW**2)

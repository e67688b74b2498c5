"""Pulmonary stenosis: a valve that opens too little and loses pressure."""

from dataclasses import dataclass

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Narrowing, mechanism
from heartfit.roles.laws import BLOOD_DENSITY

REFERENCE_FLOW = 4e-4
"""Flow [m^3/s] at which the gradient is stated: the peak of a normal ejection."""


@mechanism
@dataclass(frozen=True)
class PulmonaryStenosis(Narrowing):
    r"""Bernoulli's loss in series with the pulmonary valve, stated as the gradient G at a flow Q of 400 mL/s.

    .. math:: \Delta p = \Delta p_{valve} + G (q/Q)^2, \qquad G = \tfrac12 \rho\, Q^2 / A^2

    Mild below a peak gradient of 4.8 kPa (36 mmHg), severe from 8.5 kPa (64 mmHg): two scales are mild, four moderate.
    Source: Baumgartner et al., JASE 2009, 22:1.
    """

    valve = "pulmonary"
    gradient: float = parameter(
        2000.0,
        unit="Pa",
        symbol="G_{pu}",
        meaning="pressure that the narrowing takes at 400 mL/s",
        sd=0.5,
        off=0.0,
        scale=2000.0,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def inverse_square(self) -> float:
        return 2.0 * self.gradient / (BLOOD_DENSITY * REFERENCE_FLOW**2)

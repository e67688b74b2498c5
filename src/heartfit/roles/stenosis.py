"""Form that the narrowings of the four valves share: Bernoulli's loss, stated as a gradient at a usual flow."""

from dataclasses import dataclass
from typing import ClassVar

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles.interfaces import Narrowing
from heartfit.roles.laws import BLOOD_DENSITY


@dataclass(frozen=True)
class Stenosis(Narrowing):
    r"""Bernoulli's loss in series with a valve, stated as the gradient G at the flow Q.

    .. math:: \Delta p = \Delta p_{valve} + G (q/Q)^2, \qquad G = \tfrac12 \rho\, Q^2 / A^2

    A subclass names its ``valve`` and the flow, and declares the scale of the gradient.
    """

    reference_flow: ClassVar[float]
    """Flow Q [m^3/s] at which the gradient is stated."""
    gradient: float = parameter(
        2000.0,
        unit="Pa",
        symbol="G",
        meaning="pressure that the narrowing takes at the reference flow",
        sd=0.5,
        off=0.0,
        scale=2000.0,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def inverse_square(self) -> float:
        return 2.0 * self.gradient / (BLOOD_DENSITY * self.reference_flow**2)

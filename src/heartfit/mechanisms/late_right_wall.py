"""Late activation of the right free wall, as in right bundle branch block."""

from dataclasses import dataclass

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Amendment, mechanism


@mechanism
@dataclass(frozen=True)
class LateRightWall(Amendment):
    r"""Delay of the activation of the right free wall relative to that of the heart.

    .. math:: d \to d + \Delta d

    In right bundle branch block the right ventricle is activated 30 to 60 ms late: two scales are the middle.
    Source: Fantoni et al., J Cardiovasc Electrophysiol 2005, 16:112.
    """

    amends = "right.delay"
    delay: float = parameter(
        0.02,
        unit="s",
        symbol=r"\Delta d",
        meaning="further delay of the activation of the right wall",
        sd=0.5,
        off=0.0,
        scale=0.02,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def amend(self, value: float, period: float) -> float:  # noqa: ARG002
        return value + self.delay

"""Relaxed friction: a sarcomere that slackens, since its friction falls with the bridges that are attached."""

from dataclasses import dataclass
from math import exp

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Amendment, mechanism


@mechanism
@dataclass(frozen=True)
class RelaxedFriction(Amendment):
    r"""Friction of a sarcomere without bridges, smaller by the factor :math:`e^{-a}` than with bridges.

    .. math:: \mu(k_c) = \mu \big[ e^{-a} + (1 - e^{-a}) \min(1, 2 k_c / k_0) \big]

    A relaxed sarcomere lengthens faster: the ventricle fills faster early and keeps its volume in diastasis. a = 0 is a
    friction that does not depend on the bridges.
    Source: the internal viscous element of the sarcomere in de Tombe and ter Keurs, J Physiol 1992, 454:619; its
    dependence on k_c is a simple choice of this project.
    """

    amends = "active.relaxed_friction"
    slackening: float = parameter(
        1.2,
        unit="1",
        symbol="a_{\\mu}",
        meaning="logarithm of the friction with bridges over that without",
        off=0.0,
        scale=0.8,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def amend(self, value: float, period: float) -> float:  # noqa: ARG002
        return value * exp(-self.slackening)

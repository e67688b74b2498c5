"""Length dependence: muscle that contracts harder where it is stretched more."""

from dataclasses import dataclass

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Amendment, mechanism


@mechanism
@dataclass(frozen=True)
class LengthDependence(Amendment):
    r"""Starling effect whose slope exceeds that of the law by a.

    .. math:: n_0 = \max\big(0,\; 1 - (s + a)\,(1 - n(x + x_0))\big)

    with the table n of :class:`~heartfit.heart.muscle.control.Starling`; a < 0 is a weaker effect, as in failing
    muscle, or descending.
    Sources: ter Keurs et al., Circ Res 1980, 46:703; Kentish et al., Circ Res 1986, 58:755; its loss in failing
    muscle in Schwinger et al., Circ Res 1994, 74:959.
    """

    amends = "active.starling.slope"
    strengthening: float = parameter(
        0.5, unit="1", symbol="a", meaning="slope added to the Starling effect", off=0.0, low=-5.0, scale=0.5
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def amend(self, value: float, period: float) -> float:  # noqa: ARG002
        return value + self.strengthening

"""Length dependence: muscle that contracts harder where it is stretched more."""

from dataclasses import dataclass

from heartfit.mechanism import Amendment, mechanism
from heartfit.parameter import parameter, require_admissible


@mechanism
@dataclass(frozen=True)
class LengthDependence(Amendment):
    r"""Starling effect that is stronger by a than that of the law.

    .. math:: n_0 = 1 - (s + a)\,(1 - n(x + x_0))

    with the table n of :class:`~heartfit.mechanics.active.starling.Starling`; a < 0 is a weaker effect, as in failing
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

    def amended(self, value: float, period: float) -> float:  # noqa: ARG002
        return value + self.strengthening

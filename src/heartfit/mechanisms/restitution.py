"""Restitution: an action potential that is shorter at a fast heart rate."""

from dataclasses import dataclass

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Amendment, mechanism


@mechanism
@dataclass(frozen=True)
class Restitution(Amendment):
    r"""Duration of the action potential as a power of the period T.

    .. math:: \mathrm{APD}(T) = \mathrm{APD} \, (T / T_1)^a

    where APD is that at the period :math:`T_1` of 1 s, to which clinics correct the QT interval: a = 1/2 is Bazett's
    formula, 1/3 Fridericia's, 0 a systole of the same length at every rate. At one rate it cannot be told from another
    APD; recordings at two rates reveal it by their diastoles.
    Sources: Bazett, Heart 1920, 7:353; Elharrar and Surawicz, Am J Physiol 1983, 244:H782.
    """

    amends = "control.duration"
    power: float = parameter(
        0.5, unit="1", symbol="a", meaning="power of the period in the action potential", off=0.0, scale=0.5
    )
    corrected: float = parameter(
        1.0, unit="s", symbol="T_1", meaning="period at which the law's duration holds", low=0.1
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def amend(self, value: float, period: float) -> float:
        return float(value * (period / self.corrected) ** self.power)

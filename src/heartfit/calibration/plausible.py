"""Rule for the prior: the range of each parameter in which the beat remains plausible.

The paper sets C_X "by estimating the minimal and the maximal value of each parameter with a trial and error approach
on one volunteer". Here each quantity y of the beat (ejection fraction, peak pressure, ...) is the parabola in
t = ln(theta / theta_0) through the beat of the standard heart (t = 0) and the two at -h and +h. The range ends where
the first parabola leaves its published limits, or at a cap. With its ends :math:`t_- < 0 < t_+`,

    X0 = theta_0 exp((t_- + t_+) / 2),   sd = (t_+ - t_-) / 4.

A limit that the standard heart violates does not constrain a single parameter; it is omitted and named.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import copysign, exp, inf, isfinite, log, sqrt

from heartfit.calibration.unscented import Outcome, SigmaPoint
from heartfit.core.errors import InputError

CAP = "cap"
NO_BEAT = "no beat"


@dataclass(frozen=True)
class Limit:
    """Least and largest plausible value of a quantity [SI]; infinite without a published limit."""

    quantity: str
    low: float
    high: float

    def holds(self, value: float) -> bool:
        return self.low <= value <= self.high


@dataclass(frozen=True)
class End:
    """One end of the plausible range: the factor over the standard value, and the limit reached there."""

    factor: float
    stopped_by: str


@dataclass(frozen=True)
class PlausibleRange:
    """Both ends of a parameter whose standard value is `standard`, SI."""

    parameter: str
    standard: float
    lowest: End
    highest: End

    @property
    def median(self) -> float:
        """X0, SI."""
        return self.standard * sqrt(self.lowest.factor * self.highest.factor)

    @property
    def sd(self) -> float:
        """Standard deviation of the logarithm."""
        return log(self.highest.factor / self.lowest.factor) / 4.0


@dataclass(frozen=True)
class Plausible:
    """Range of every parameter, and the quantities whose limits the standard beat violates."""

    ranges: tuple[PlausibleRange, ...]
    broken: tuple[str, ...]

    @property
    def sd(self) -> list[float]:
        """Standard deviations of the logarithms, in the order of the parameters."""
        return [entry.sd for entry in self.ranges]


def plausible_ranges(
    points: Sequence[SigmaPoint], outcomes: Sequence[Outcome], limits: Sequence[Limit], cap: float
) -> Plausible:
    """Return the ranges from the outcomes of the points about the prior's mean, in the order of `sigma_points`.

    outcomes contain every quantity with a limit; cap > 1: largest factor. The range ends halfway to a failed beat.
    Raises InputError if the beat at the mean failed.
    """
    centre, n = outcomes[0], len(points) // 2
    if isinstance(centre, str):
        raise InputError(f"plausible ranges: the beat at the prior's mean failed ({centre}): move the mean")
    broken = tuple(limit.quantity for limit in limits if not limit.holds(centre[limit.quantity]))
    kept = [limit for limit in limits if limit.quantity not in broken]
    ranges = []
    for i, (name, value) in enumerate(points[0].parameters.items()):
        h = float(points[1 + i].z[i] - points[0].z[i])
        up, down = outcomes[1 + i], outcomes[1 + n + i]
        below, above = (_reach(h, centre, *pair, kept, cap) for pair in ((down, up), (up, down)))
        lowest, highest = End(exp(-below[0]), below[1]), End(exp(above[0]), above[1])
        ranges.append(PlausibleRange(name, value, lowest, highest))
    return Plausible(tuple(ranges), broken)


def _reach(
    h: float,
    centre: Mapping[str, float],
    ahead: Outcome,
    behind: Outcome,
    limits: Sequence[Limit],
    cap: float,
) -> tuple[float, str]:
    """Distance t > 0 towards the beat `ahead` at which the first limit is reached, and its quantity."""
    if isinstance(ahead, str):
        return min((h / 2.0, NO_BEAT), (log(cap), CAP))
    ends = [(log(cap), CAP)]
    for limit in limits:
        y, end = centre[limit.quantity], ahead[limit.quantity]
        start = 2.0 * y - end if isinstance(behind, str) else behind[limit.quantity]
        slope, bend = (end - start) / (2.0 * h), (end + start - 2.0 * y) / (2.0 * h * h)
        bounds = filter(isfinite, (limit.low, limit.high))
        ends += [(_first_root(bend, slope, y - bound), limit.quantity) for bound in bounds]
    return min(ends)


def _first_root(a: float, b: float, c: float) -> float:
    """Least t > 0 with a t^2 + b t + c = 0; infinite if there is none."""
    discriminant = b * b - 4.0 * a * c
    if discriminant < 0.0:
        return inf
    q = -0.5 * (b + copysign(sqrt(discriminant), b))  # avoids cancellation
    roots = [part / whole for part, whole in ((q, a), (c, q)) if whole != 0.0]
    return min((root for root in roots if root > 0.0), default=inf)

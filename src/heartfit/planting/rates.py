"""The figures of a benchmark, counted over its cases, and what the counts allow to say."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from scipy.special import betainc

from heartfit.observation.coverage import Share
from heartfit.planting.scoring import Scored

Holds = Callable[[Scored], bool]


@dataclass(frozen=True)
class Rate:
    """Of the cases ``among``, the share of which something ``holds``, and the target that was set for it, if any."""

    name: str
    among: Holds
    holds: Holds
    target: float | None = None
    at_most: bool = False

    def counted(self, scored: Iterable[Scored]) -> Share | None:
        """The share with its exact 95 % interval; None of no case."""
        held = [self.holds(each) for each in scored if self.among(each)]
        return Share.of(float(sum(held)), len(held)) if held else None

    def met(self, share: Share) -> bool | None:
        """Whether the share itself meets the target; None without one."""
        if self.target is None:
            return None
        return share.covered <= self.target if self.at_most else share.covered >= self.target


def _null(each: Scored) -> bool:
    return each.answer.kind == "none"


def _single(each: Scored) -> bool:
    return each.answer.kind == "single"


def _outsider(each: Scored) -> bool:
    return each.answer.kind == "outside"


def _pair(each: Scored) -> bool:
    return each.answer.kind == "two"


RATES = (
    Rate("false alarms of nulls", _null, lambda each: each.detected, 0.04, at_most=True),
    Rate("nulls that were given a name", _null, lambda each: each.named),
    Rate(
        "singles detected at 2 scales", lambda each: _single(each) and each.scales == 2.0,
        lambda each: each.detected, 0.75,
    ),
    Rate("singles detected at more", lambda each: _single(each) and each.scales > 2.0, lambda each: each.detected),
    Rate("singles named right, of the named", lambda each: _single(each) and each.named, lambda each: each.right, 0.95),
    Rate("named right, of all that were named", lambda each: each.named, lambda each: each.right),
    Rate(
        "singles in their group, of the groups", lambda each: _single(each) and each.finding.verdict == "group",
        lambda each: each.in_group,
    ),
    Rate("outsiders detected", _outsider, lambda each: each.detected),
    Rate(
        "outsiders called unknown, of the detected", lambda each: _outsider(each) and each.detected,
        lambda each: each.finding.verdict == "unknown", 0.85,
    ),
    Rate("pairs with both right", _pair, lambda each: each.right),
    Rate(
        "pairs with a wrong pair", _pair, lambda each: each.finding.verdict == "two" and not each.right, 0.02,
        at_most=True,
    ),
    Rate("pairs with one name, and right", _pair, lambda each: each.named and each.finding.names < each.truth),
)  # fmt: skip


def doubt(share: Share, claim: float, at_most: bool) -> float:
    r"""How probable so bad a count, or a worse one, is if the rate behind it is the ``claim``.

    .. math:: P(X \ge k) \text{ for a rate of at most } p, \qquad P(X \le k) \text{ for one of at least } p, \qquad
              X \sim \mathrm{Bin}(n, p)
    """
    n = share.sequences
    k = round(share.covered * n)
    if at_most:
        return float(betainc(k, n - k + 1, claim)) if k > 0 else 1.0
    return float(betainc(n - k, k + 1, 1.0 - claim)) if k < n else 1.0

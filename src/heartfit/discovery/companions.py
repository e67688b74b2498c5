"""The search for a second effect beside the best single ones: those that promise enough are fitted."""

from collections.abc import Callable, Sequence

from heartfit.discovery.bench import Bench
from heartfit.discovery.decide import Effects
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.hypothesis import Hypothesis
from heartfit.discovery.promise import Promise, promise

Combined = Callable[[Effects], Hypothesis]
"""The hypothesis of two effects by their names."""


def pairs_of(
    bench: Bench, singles: Sequence[Explanation], combined: Combined, fitted: Sequence[int], least: float
) -> list[Explanation]:
    """Pairs fitted: up to ``fitted[i]`` with the i-th single effect, each of which promises ``least`` ln Z more."""
    names = [each.effects[0] for each in singles]
    pairs: dict[Effects, Explanation] = {}
    for single, count in zip(singles, fitted, strict=False):
        both = [_sorted(single.effects[0], name) for name in names if name not in single.effects]
        promises = [promise(bench, single, combined(each)) for each in both if each not in pairs]
        best = [
            each
            for each in promises
            if each is not None and each.log_evidence > singles[0].log_evidence + least
        ]
        found = [each.kept(bench) for each in sorted(best, key=_falling)[:count]]
        pairs |= {each.effects: each for each in found if each is not None}
    return list(pairs.values())


def _sorted(one: str, other: str) -> Effects:
    return (min(one, other), max(one, other))


def _falling(each: Promise) -> float:
    return -each.log_evidence

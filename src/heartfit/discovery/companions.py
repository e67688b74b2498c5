"""The search for a second effect beside the best single ones: those that promise enough are fitted."""

from collections.abc import Callable, Sequence

from heartfit.discovery.bench import Bench
from heartfit.discovery.decide import Effects
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.hypothesis import Hypothesis
from heartfit.discovery.promise import Promise, promise
from heartfit.discovery.rules import Rules

Combined = Callable[[Effects], Hypothesis]
"""The hypothesis of two effects by their names."""


def pairs_of(
    bench: Bench, singles: Sequence[Explanation], combined: Combined, rules: Rules
) -> list[Explanation]:
    """The pairs fitted: of all with one of the best single effects those that promise most over the best of them."""
    promised = _promised(bench, singles, combined, rules.partners)
    least = singles[0].log_evidence + rules.promising
    best = sorted((each for each in promised if each.log_evidence > least), key=_falling)[: rules.pairs]
    found = [each.kept(bench) for each in best]
    return [each for each in found if each is not None]


def _promised(
    bench: Bench, singles: Sequence[Explanation], combined: Combined, partners: int
) -> list[Promise]:
    """What each pair promises from the better of its effects."""
    found: dict[Effects, Promise | None] = {}
    for single in singles[:partners]:
        others = [each.effects[0] for each in singles if each is not single]
        both = [_sorted(single.effects[0], other) for other in others]
        found |= {each: promise(bench, single, combined(each)) for each in both if each not in found}
    return [each for each in found.values() if each is not None]


def _sorted(one: str, other: str) -> Effects:
    return (min(one, other), max(one, other))


def _falling(each: Promise) -> float:
    return -each.log_evidence

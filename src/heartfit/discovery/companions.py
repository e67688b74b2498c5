"""The search for a second effect beside the best single ones.

From the fit of one effect, each other one is switched on at its typical size, one simulation each; the secant takes the
place of its slope, and the linear evidence of the two ranks them. Only the most promising are fitted.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.discovery.bench import Bench
from heartfit.discovery.decide import Effects
from heartfit.discovery.evidence import posterior
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.hypothesis import Hypothesis
from heartfit.geometry.arrays import Floats

Combined = Callable[[Effects], Hypothesis]
"""The hypothesis of two effects by their names."""
REACH = (0.3, 3.0)
"""Amplitudes between which the fit of a second effect starts: the linear promise is cut off there."""


@dataclass(frozen=True, eq=False)
class _Promise:
    """Two effects as the linear model sees them from the fit of one: where their fit may start, and ln Z."""

    hypothesis: Hypothesis
    start: Floats
    log_evidence: float


def pairs_of(
    bench: Bench, singles: Sequence[Explanation], combined: Combined, fitted: Sequence[int]
) -> list[Explanation]:
    """Pairs fitted: ``fitted[i]`` of those with the i-th single effect."""
    names = [each.effects[0] for each in singles]
    pairs: dict[Effects, Explanation] = {}
    for single, count in zip(singles, fitted, strict=False):
        others = [name for name in names if name not in single.effects]
        both = [combined(_sorted(single.effects[0], other)) for other in others]
        promises = [_promise(bench, single, each) for each in both if each.effects not in pairs]
        promising = sorted((each for each in promises if each), key=lambda each: -each.log_evidence)[:count]
        found = [bench.explain(each.hypothesis, each.start) for each in promising]
        pairs |= {each.effects: each for each in found if each is not None}
    return list(pairs.values())


def _sorted(one: str, other: str) -> Effects:
    return (min(one, other), max(one, other))


def _promise(bench: Bench, single: Explanation, both: Hypothesis) -> _Promise | None:
    """What the linear model promises of a second effect, or None where its simulation fails."""
    known = np.array([both.names.index(name) for name in single.fit.hypothesis.names])
    second = both.amplitudes & ~np.isin(np.arange(len(both.names)), known)
    x = np.zeros(len(both.names))
    x[known] = single.fit.x
    switched = bench.simulate(both, np.where(second, 1.0, x))
    if switched is None:
        return None
    slopes = np.zeros((single.fit.predicted.size, x.size))
    slopes[:, known] = single.fit.jacobian
    slopes[:, second] = (switched - single.fit.predicted)[:, None]
    seen = posterior(bench.whitening, x, bench.data.values - single.fit.predicted, slopes, both.one_sided)
    start = np.maximum(np.where(second, _within_reach(seen.mean), x), both.lower)
    return _Promise(both, start, seen.log_evidence)


def _within_reach(amplitude: Floats) -> Floats:
    return np.where(amplitude < 0.0, -1.0, 1.0) * np.clip(np.abs(amplitude), *REACH)

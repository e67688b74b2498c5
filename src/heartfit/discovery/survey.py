"""Everything that was fitted to the data, and the rounds of fits that fill it."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from heartfit.discovery.bench import Bench
from heartfit.discovery.decide import Effects, Evidences, suspected
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.hypothesis import Hypothesis
from heartfit.discovery.promise import most_promising, promises
from heartfit.discovery.rival import Rival
from heartfit.discovery.rules import Rules
from heartfit.errors import InputError

ABOVE = 0.05
"""How much above none an effect's objective may end and count as its equal."""
PATIENCE = 50.0
"""How much above what it reached from none an effect from the centre may promise to end, its slopes being fresh."""
FEW = 3
"""Sides on which an effect with one further unknown can start."""


@dataclass(frozen=True, eq=False)
class Survey:
    """none, and singles and pairs in descending evidence; failed: effects no simulation of which was completed."""

    none: Explanation
    singles: tuple[Explanation, ...]
    pairs: tuple[Explanation, ...] = ()
    failed: tuple[Effects, ...] = ()

    def evidences(self, rival: Rival) -> Evidences:
        """Their ln evidence beside that of the rival, alone and on top of the best."""
        best = [*self.singles[:1], *self.pairs[:1]]
        return Evidences(
            self.none.log_evidence,
            {each.effects: each.log_evidence for each in self.singles},
            rival.log_evidence(self.none.fit),
            {each.effects: rival.log_evidence(each.fit) for each in best},
            {each.effects: each.log_evidence for each in self.pairs},
        )


def ranked(explanations: Iterable[Explanation]) -> tuple[Explanation, ...]:
    """In descending evidence."""
    return tuple(sorted(explanations, key=lambda each: each.log_evidence, reverse=True))


def surveyed(bench: Bench, none: Hypothesis, singles: Sequence[Hypothesis], rules: Rules) -> Survey:
    """None and every single effect, fitted from none and from the centre; where anything is suspected, the best again.

    A weak effect hardly moves the fit without it, and the slopes there lead on. A strong one drags that fit to where
    they no longer point at the cause: so each effect starts at the centre of the priors too, strongly switched on, at
    the place and time where it promises most.
    """
    centre, base = _without_effect(bench, none)
    found = {each.effects: _found(bench, base, centre, each, rules) for each in singles}
    near = ranked(each for each in found.values() if each is not None)
    if not near:
        raise InputError("search: no effect has a simulation that is completed; expected one at least")
    survey = Survey(base, near, failed=tuple(name for name, each in found.items() if each is None))
    return _again(bench, centre, survey, rules) if suspected(survey.evidences(bench.rival), rules) else survey


def _without_effect(bench: Bench, none: Hypothesis) -> tuple[Explanation, Explanation]:
    """None at the centre of the priors, and fitted, once more from where the first fit ends."""
    centre = bench.linear(none, none.at(0.0))
    fitted = None if centre is None else bench.explain(none, centre.fit.x, centre.fit.jacobian)
    if centre is None or fitted is None:
        raise InputError(
            "search: the simulation at the centre of the priors fails; expected one to start from"
        )
    return centre, bench.better(fitted, fitted.fit.x)


def _found(
    bench: Bench, base: Explanation, centre: Explanation, hypothesis: Hypothesis, rules: Rules
) -> Explanation | None:
    near = from_none(bench, base, hypothesis)
    begun = _begun(bench, centre, hypothesis, rules)
    if begun is None or near is None:
        return near or begun
    return bench.better(near, begun.fit.x, begun.fit.jacobian, patience=PATIENCE)


def _begun(bench: Bench, centre: Explanation, hypothesis: Hypothesis, rules: Rules) -> Explanation | None:
    """An effect's best fit from the centre as far as the first fresh slopes.

    Of one further unknown the promise tells the side to start on, of two of them, as where and how large, it does not.
    """
    found = promises(bench, centre, hypothesis, (rules.switched, rules.switched))
    found.sort(key=lambda each: -each.log_evidence)
    sides = found if len(found) > FEW else found[:1]
    fits = [bench.explain(hypothesis, each.start, each.slopes, target=-np.inf) for each in sides]
    return min((each for each in fits if each is not None), key=lambda each: each.fit.objective, default=None)


def from_none(bench: Bench, base: Explanation, hypothesis: Hypothesis) -> Explanation | None:
    """An effect fitted from where none ended, which it may not end above, with none's slopes of what both share."""
    promised, shared = most_promising(bench, base, hypothesis), base.fit.x.size
    found = None if promised is None else promised.kept(bench, shared)
    if promised is None or found is None or _nested(found, base):
        return found
    start = hypothesis.at(0.0)
    start[:shared] = base.fit.x
    return bench.better(found, start, promised.slopes, shared)


def _nested(single: Explanation, none: Explanation) -> bool:
    return single.fit.objective <= none.fit.objective + ABOVE


def _again(bench: Bench, centre: Explanation, survey: Survey, rules: Rules) -> Survey:
    """The best effects with fresh slopes and from every side, and none from what explains most.

    Where none comes to fit better than an effect, that one follows.
    """
    settled = ranked(_settled(bench, each) for each in survey.singles[: rules.settled])
    spread = [_from_every_side(bench, centre, each, rules) for each in settled[: rules.spread]]
    singles = ranked([*spread, *settled[rules.spread :], *survey.singles[rules.settled :]])
    none = _none_again(bench, survey.none, singles[0])
    followed = [
        each if _nested(each, none) else from_none(bench, none, each.fit.hypothesis) for each in singles
    ]
    return replace(survey, singles=ranked(each for each in followed if each is not None), none=none)


def _settled(bench: Bench, near: Explanation) -> Explanation:
    return bench.explain(near.fit.hypothesis, near.fit.x, near.fit.jacobian) or near


def _from_every_side(bench: Bench, centre: Explanation, near: Explanation, rules: Rules) -> Explanation:
    for promised in promises(bench, centre, near.fit.hypothesis, (rules.switched, rules.switched)):
        near = bench.better(near, promised.start)
    return near


def _none_again(bench: Bench, base: Explanation, best: Explanation) -> Explanation:
    known = base.fit.x.size
    return bench.better(base, best.fit.x[:known], best.fit.jacobian[:, :known])


def polished(bench: Bench, survey: Survey, rules: Rules) -> Survey:
    """The best effects started again with other amplitudes."""
    again = [_polished(bench, each, rules.polish) for each in survey.singles[: rules.polished]]
    return replace(survey, singles=ranked([*again, *survey.singles[rules.polished :]]))


def _polished(bench: Bench, explanation: Explanation, amplitudes: Sequence[float]) -> Explanation:
    for amplitude in amplitudes:
        start = explanation.fit.hypothesis.at(amplitude)
        explanation = bench.better(explanation, start, explanation.fit.jacobian)
    return explanation

"""Everything that was fitted to the data, and the rounds of fits that fill it."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from heartfit.discovery.bench import Bench
from heartfit.discovery.decide import Effects, Evidences
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.hypothesis import Hypothesis
from heartfit.discovery.rival import Rival
from heartfit.errors import InputError

BELOW = 0.05
"""How much higher than that of none an objective may end and still count as its equal."""


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


def surveyed(bench: Bench, none: Hypothesis, singles: Sequence[Hypothesis]) -> Survey:
    """None and every single effect, each from the centre of the priors with the effect at its typical size."""
    base = bench.explain(none, none.at(0.0))
    if base is None:
        raise InputError(
            "search: the simulation at the centre of the priors fails; expected one to start from"
        )
    found = {each.effects: _nested(bench, each, base) for each in singles}
    explained = ranked(each for each in found.values() if each is not None)
    if not explained:
        raise InputError("search: no effect has a simulation that is completed; expected one at least")
    base = bench.better(base, explained[0].fit.x[: base.fit.x.size])
    return Survey(base, explained, failed=tuple(name for name, each in found.items() if each is None))


def _nested(bench: Bench, hypothesis: Hypothesis, base: Explanation) -> Explanation | None:
    """An effect's fit; started again from that of none where it ends above it."""
    found = bench.explain(hypothesis, hypothesis.at(1.0))
    if found is not None and found.fit.objective <= base.fit.objective + BELOW:
        return found
    start = hypothesis.at(0.0)
    start[: base.fit.x.size] = base.fit.x
    return bench.explain(hypothesis, start) if found is None else bench.better(found, start)


def polished(bench: Bench, survey: Survey, amplitudes: Sequence[float], count: int) -> Survey:
    """The best ``count`` effects started again with these amplitudes."""
    again = [_polished(bench, each, amplitudes) for each in survey.singles[:count]]
    return replace(survey, singles=ranked([*again, *survey.singles[count:]]))


def _polished(bench: Bench, explanation: Explanation, amplitudes: Sequence[float]) -> Explanation:
    for amplitude in amplitudes:
        explanation = bench.better(explanation, explanation.fit.hypothesis.at(amplitude))
    return explanation

"""A recording after its search."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import cast

from heartfit.diagnosis.cause import Cause, Tried, Verdict
from heartfit.diagnosis.centre import HUMAN, Centre
from heartfit.diagnosis.library import Candidate, candidates, hypothesis
from heartfit.diagnosis.record import data_of
from heartfit.diagnosis.recording import Recording
from heartfit.diagnosis.twin import Twin
from heartfit.discovery.data import Data
from heartfit.discovery.decide import Effects
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.rules import RULES, Rules
from heartfit.discovery.search import Findings, search
from heartfit.observation.beat import beat_curves
from heartfit.observation.beat_phases import BeatPhases

VOLUME_ALONE = 10.0
"""ln Bayes factor that a volume alone must give: it shows one in nine of the effects that pressure makes plain, and an
instrument explains a curve as well as a heart does."""
NAMES = ("named", "two", "group")


@dataclass(frozen=True, eq=False)
class Case:
    """A recording after its search."""

    recording: Recording
    twin: Twin
    library: Mapping[str, Candidate]
    data: Data
    findings: Findings
    rules: Rules

    @classmethod
    def searched(cls, recording: Recording, centre: Centre | None = None, rules: Rules = RULES) -> "Case":
        """Every mechanism, pairs and the unknown fitted to the recording; for the centre see :func:`diagnose`."""
        data = data_of(recording)
        twin = Twin(
            centre or HUMAN.of_the_size_of(recording), {block.curve: block.times for block in data.blocks}
        )
        library = candidates(twin)
        if recording.searched == ("lv_volume",):
            rules = replace(rules, detected=max(rules.detected, VOLUME_ALONE))
        findings = search(
            data,
            hypothesis(twin),
            [hypothesis(twin, (each,)) for each in library.values()],
            lambda names: hypothesis(twin, tuple(library[name] for name in names)),
            rules,
        )
        return cls(recording, twin, library, data, findings, rules)

    @cached_property
    def verdict(self) -> Verdict:
        """What the search says before anything is held out."""
        verdict = cast("Verdict", str(self.findings.decision.verdict))
        alone = self.recording.searched == ("lv_volume",)
        return "insufficient" if alone and verdict not in NAMES else verdict

    @property
    def explanations(self) -> tuple[Effects, ...]:
        """Effects that are named: the best ones, and in a group all that the data do not tell from them."""
        decision = self.findings.decision
        others = decision.alternatives if self.verdict == "group" else ()
        return (decision.effects, *others) if decision.effects else ()

    def cause(self, effects: Effects, name: str) -> Cause:
        """A mechanism, as large as the explanation by these effects says."""
        explained = self.findings.of(effects)
        switch = self.library[name].unknowns[0]
        amplitude, low, high = map(switch.at, explained.interval(f"{name}.{switch.name}"))
        factor = self.findings.log_bayes_factor(effects)
        return Cause(name, factor, amplitude, switch.unit, (low, high))

    def ranking(self) -> dict[str, float]:
        """ln Bayes factors over none, falling."""
        evidences = self.findings.evidences
        factors = {each[0]: value - evidences.none for each, value in evidences.singles.items()}
        factors["unknown"] = evidences.rival - evidences.none
        return dict(sorted(factors.items(), key=lambda each: -each[1]))

    def tried(self) -> tuple[Tried, ...]:
        """Every model that was fitted: without effects, with one, with two."""
        survey = self.findings.survey
        return tuple(map(_tried, (survey.none, *survey.singles, *survey.pairs)))

    def phases(self) -> BeatPhases | None:
        """Those of the beat that was fitted without a cause."""
        reached = self.twin.reached(self.findings.survey.none.fit.x)
        if reached is None:
            return None
        heart, beat = reached
        try:
            return BeatPhases.of(beat_curves(replace(beat, trigger=heart.trigger)))
        except ValueError:
            return None


def _tried(explained: Explanation) -> Tried:
    """The objective of a fit is -ln p(y | x) + |x|^2 / 2."""
    fit = explained.fit
    likelihood = fit.objective - 0.5 * float(fit.x @ fit.x)
    return Tried(explained.effects, explained.log_evidence, likelihood, fit.x.size)

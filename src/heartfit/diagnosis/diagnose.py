"""From a recording to the cause of what a simulation of the heart gets wrong; see docs/discovery.md."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import cast

from heartfit.diagnosis.cause import Cause, Diagnosis, Verdict
from heartfit.diagnosis.centre import HUMAN, Centre
from heartfit.diagnosis.held_out import Predicted, in_condition, on_half
from heartfit.diagnosis.library import Candidate, candidates, hypothesis
from heartfit.diagnosis.next_measurement import PRESSURE, next_measurement
from heartfit.diagnosis.record import data_of
from heartfit.diagnosis.recording import Recording
from heartfit.diagnosis.trace import traces
from heartfit.diagnosis.twin import Twin
from heartfit.discovery.data import Data
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.rules import RULES, Rules
from heartfit.discovery.search import Findings, search

VOLUME_ALONE = 10.0
"""ln Bayes factor that a volume alone must give: it shows one in nine of the effects that pressure makes plain, and an
instrument explains a curve as well as a heart does."""
NAMES = ("named", "two", "group")


def diagnose(
    recording: Recording,
    conditions: Mapping[str, Recording] | None = None,
    centre: Centre | None = None,
    rules: Rules = RULES,
) -> Diagnosis:
    """What the model of the heart lacks to explain the recording.

    conditions: the same heart under other loading, by name; never fitted but for the loading. centre: a sphere that was
    fitted to a beat of the 3-D model; the one of an adult, grown to the recorded size, if None. Raises InputError where
    the centre does not beat.
    """
    return Case.searched(recording, centre, rules).concluded(conditions or {})


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

    def concluded(self, conditions: Mapping[str, Recording]) -> Diagnosis:
        """The diagnosis after what was held out decides whether a name is kept."""
        held_out = list(self.held_out(conditions))
        withdrawn = self.names if any(not each.helps() for each in held_out) else ()
        return self.diagnosis(held_out, withdrawn)

    @cached_property
    def verdict(self) -> Verdict:
        """What the search says before anything is held out."""
        verdict = cast("Verdict", str(self.findings.decision.verdict))
        alone = self.recording.searched == ("lv_volume",)
        return "insufficient" if alone and verdict not in NAMES else verdict

    @property
    def names(self) -> tuple[str, ...]:
        """The mechanisms of the best explanation."""
        return self.findings.decision.effects

    def held_out(self, conditions: Mapping[str, Recording]) -> Iterator[Predicted]:
        """Predictions without and with what is named, of every condition or, without one, of half of the recording."""
        if not self.names:
            return
        effects = tuple(self.library[name] for name in self.names)
        fits = self.findings.survey.none.fit.x, self.findings.best.fit.x
        centre = self.twin.centre
        found = [
            in_condition(name, centre, data_of(each), effects, *fits) for name, each in conditions.items()
        ] or [on_half(centre, self.data, effects, *fits)]
        yield from (each for each in found if each is not None)

    def causes(self) -> tuple[Cause, ...]:
        """What is named: one mechanism or two, or all that the data do not tell apart."""
        if self.verdict == "group":
            every = [self.names, *self.findings.decision.alternatives]
            return tuple(self._cause(self.findings.of(each), each[0]) for each in every)
        return tuple(self._cause(self.findings.best, name) for name in self.names)

    def _cause(self, explained: Explanation, name: str) -> Cause:
        switch = self.library[name].unknowns[0]
        amplitude, low, high = map(switch.at, explained.interval(f"{name}.{switch.name}"))
        factor = self.findings.log_bayes_factor(explained.effects)
        return Cause(name, factor, amplitude, switch.unit, (low, high))

    def ranking(self) -> dict[str, float]:
        """ln Bayes factors over none, falling."""
        evidences = self.findings.evidences
        factors = {each[0]: value - evidences.none for each, value in evidences.singles.items()}
        factors["unknown"] = evidences.rival - evidences.none
        return dict(sorted(factors.items(), key=lambda each: -each[1]))

    def next_measurement(self, verdict: Verdict) -> str:
        """What would decide what is open: between the members of a group, or none and the best where a name failed."""
        if "lv_pressure" not in self.recording.curves:
            return PRESSURE
        of = self.findings.of
        rivals = {
            "group": [of(self.names), *map(of, self.findings.decision.alternatives[:2])]
            if self.names
            else [],
            "unknown": list(self.findings.survey.singles[:2]),
        }.get(verdict, [])
        if len(rivals) < 2:
            return ""
        return next_measurement(self.twin.centre, self.data, self.library, rivals)

    def diagnosis(self, held_out: list[Predicted], withdrawn: tuple[str, ...]) -> Diagnosis:
        """The verdict after what was held out has been predicted."""
        verdict: Verdict = "unknown" if withdrawn else self.verdict
        return Diagnosis(
            verdict,
            () if withdrawn else self.causes(),
            self.findings.decision.alternatives,
            self.next_measurement(verdict),
            tuple(gain for each in held_out for gain in each.gains()),
            self.twin.simulations,
            self.recording.period,
            self.rules.detected,
            self.ranking(),
            withdrawn,
            traces(self.findings, self.data),
        )

"""The search for what a model lacks: none, every single effect, pairs and the unknown, all fitted to the same data.

All coordinates stay free under their priors in every hypothesis: with some of them held, their misfit takes the name of
an effect. Every fit starts at the centre of the priors with the effect switched on, not at the fit without it, which a
strong effect drags away to where the slopes no longer point at the cause. No hypothesis may fit worse than none, which
it contains, and none is fitted again from the best effect's coordinates: what still improves was no effect.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from heartfit.discovery.bench import Bench
from heartfit.discovery.companions import Combined, pairs_of
from heartfit.discovery.data import Data
from heartfit.discovery.decide import Decision, Effects, Evidences, decide, detected, named
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.hypothesis import Hypothesis
from heartfit.discovery.rival import Discrepancy
from heartfit.discovery.rules import RULES, Rules
from heartfit.discovery.survey import Survey, polished, ranked, surveyed


@dataclass(frozen=True, eq=False)
class Findings:
    """Verdict and everything it rests on.

    lacking: what the model without effects does not explain of each curve; left: what the verdict's explanation does
    not; simulations: how many forward runs it took.
    """

    decision: Decision
    evidences: Evidences
    survey: Survey
    lacking: tuple[Discrepancy, ...]
    left: tuple[Discrepancy, ...]
    simulations: int

    @property
    def best(self) -> Explanation:
        """The explanation that the verdict names: that of no effect where it names none."""
        return self.of(self.decision.effects)

    def of(self, effects: Effects) -> Explanation:
        """The explanation by these effects; raises KeyError for effects that were not fitted."""
        every = (self.survey.none, *self.survey.singles, *self.survey.pairs)
        return {each.effects: each for each in every}[effects]

    def log_bayes_factor(self, effects: Effects) -> float:
        """ln evidence of these effects over none."""
        return self.of(effects).log_evidence - self.survey.none.log_evidence


def search(
    data: Data, none: Hypothesis, singles: Sequence[Hypothesis], combined: Combined, rules: Rules = RULES
) -> Findings:
    """What the model of ``none`` lacks to explain the data.

    combined gives the hypothesis of two effects, named in alphabetical order. Raises InputError where the simulation
    fails at the centre of the priors, or that of every effect.
    """
    bench = Bench(data)
    survey = _complete(bench, surveyed(bench, none, singles, rules), combined, rules)
    evidences = survey.evidences(bench.rival)
    decision = decide(evidences, rules)
    lacking = bench.rival.curves(survey.none.fit)
    findings = Findings(decision, evidences, survey, lacking, lacking, bench.simulations)
    return replace(findings, left=bench.rival.curves(findings.best.fit))


def _complete(bench: Bench, survey: Survey, combined: Combined, rules: Rules) -> Survey:
    """The survey with whatever its evidences ask for: other starts before "unknown", pairs where anything is found."""
    evidences = survey.evidences(bench.rival)
    if not detected(evidences, rules):
        return survey
    if not named(evidences, rules):
        survey = polished(bench, survey, rules)
    return replace(survey, pairs=ranked(pairs_of(bench, survey.singles, combined, rules)))

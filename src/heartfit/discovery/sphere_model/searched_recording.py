"""A recording with everything that a search on the sphere found in it."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.data import Data, Whitening
from heartfit.discovery.inference.decide import (
    DEFAULT_RULES,
    BesideProcess,
    Effects,
    Rules,
    Verdict,
    leading_effects,
)
from heartfit.discovery.inference.evidence import Explanation
from heartfit.discovery.inference.scale_dependence import scale_dependences
from heartfit.discovery.inference.search import Findings, search
from heartfit.discovery.sphere_model.cause import (
    CLEAR_DEVIATIONS,
    Cause,
    Change,
    FittedModel,
    Trace,
    UnnamedCandidate,
)
from heartfit.discovery.sphere_model.forward_model import (
    Candidate,
    SphereForwardModel,
    candidates,
    hypothesis,
)
from heartfit.discovery.sphere_model.free_parameters import FREE_PARAMETERS, TIME_SHIFT_INDEX, FreeParameter
from heartfit.discovery.sphere_model.misfit import deviation_of_means, phase_names
from heartfit.discovery.sphere_model.nominal_heart import NominalHeart
from heartfit.discovery.sphere_model.problem import DiscrepancyPrior, SphereProblem
from heartfit.discovery.sphere_model.recording import BALANCE, Recording
from heartfit.observation.beat import BeatPhases, beat_curves

VOLUME_ALONE = ("lv_volume",)
VOLUME_ONLY_THRESHOLD = 10.0
"""ln Bayes factor that a recording of the volume alone must give: it shows one in nine of the effects that pressure
reveals, and an instrument explains a single curve as well as a heart does."""
FAR = 4.0
"""Standard deviations of its prior beyond which a fitted parameter hints at a mistake in the recording."""
NAMING_VERDICTS = ("named", "two", "group")


@dataclass(frozen=True, eq=False)
class SearchedRecording:
    """A recording with the findings of its search; ``unseen``: samples of the same beat that were kept from it."""

    recording: Recording
    model: SphereForwardModel
    library: Mapping[str, Candidate]
    data: Data
    findings: Findings
    rules: Rules
    unseen: Recording | None = None
    structure: DiscrepancyPrior | None = None

    @classmethod
    def search(
        cls,
        recording: Recording,
        nominal: NominalHeart | None = None,
        rules: Rules = DEFAULT_RULES,
        unseen: Recording | None = None,
        structure: DiscrepancyPrior | None = None,
        left_out: Collection[str] = (),
    ) -> "SearchedRecording":
        """Fit every mechanism, pairs and the GP discrepancy to the recording.

        nominal: a sphere fitted to a beat of the 3-D model; the adult's, scaled to the recorded size, if None.
        left_out: mechanisms of the library that are not tried.
        """
        problem = SphereProblem.from_recording(recording, nominal, structure)
        data, model = problem.data, problem.model
        library = {name: one for name, one in candidates(model).items() if name not in left_out}
        if recording.searched == VOLUME_ALONE:
            rules = replace(rules, detected=max(rules.detected, VOLUME_ONLY_THRESHOLD))
        findings = search(
            data,
            hypothesis(model),
            [hypothesis(model, (candidate,)) for candidate in library.values()],
            lambda names: hypothesis(model, tuple(library[name] for name in names)),
            rules,
        )
        return cls(recording, model, library, data, findings, findings.rules, unseen, structure)

    @cached_property
    def unseen_problem(self) -> SphereProblem | None:
        """The samples that were kept from the search, as data; None without any."""
        return None if self.unseen is None else self.problem(self.unseen)

    @cached_property
    def verdict(self) -> Verdict:
        """The verdict of the search, before held-out tests."""
        verdict = self.findings.decision.verdict
        shown = verdict in NAMING_VERDICTS or (
            verdict == "unknown" and self.recording.searched != VOLUME_ALONE
        )
        return verdict if shown else self.nothing

    @property
    def nothing(self) -> Verdict:
        """The verdict where no effect is detected; a change of one heart is told from its own discrepancy."""
        if self.recording.searched == VOLUME_ALONE:
            return "insufficient"
        other_model = self.findings.structural_scale > 0.0 and self.model.nominal.stands_for == "people"
        return "model" if other_model else "none"

    @property
    def verdict_without_name(self) -> Verdict:
        """The verdict where no mechanism is named: by the evidence for a GP discrepancy alone."""
        evidences = self.findings.evidences
        if evidences.discrepancy - evidences.baseline >= self.rules.detected:
            return "unknown"
        return self.nothing

    @property
    def explanations(self) -> tuple[Effects, ...]:
        """Named effects: the best ones, and in a group all that the data do not distinguish from them."""
        decision = self.findings.decision
        others = decision.alternatives if self.verdict == "group" else ()
        return (decision.effects, *others) if decision.effects else ()

    @property
    def unnamed(self) -> Effects:
        """Leading effects that are detected but not named; empty if there are none."""
        if self.findings.decision.verdict != "unknown":
            return ()
        leading = leading_effects(self.findings.evidences, self.rules)
        return leading if self.findings.log_bayes_factor(leading) >= self.rules.detected else ()

    def candidate(self) -> UnnamedCandidate | None:
        """The unnamed effects with their amplitudes, and how they compare with the process; None without any."""
        if not self.unnamed:
            return None
        causes = tuple(self.cause(self.unnamed, name) for name in self.unnamed)
        return UnnamedCandidate(causes, BesideProcess.of(self.findings.evidences, self.unnamed, self.rules))

    def cause(self, effects: Effects, name: str) -> Cause:
        """A mechanism with its amplitude in the explanation by these effects."""
        return self._cause(self.findings.explanation(effects), effects, name)

    def _cause(self, explained: Explanation, effects: Effects, name: str) -> Cause:
        switch = self.library[name].unknowns[0]
        amplitude, low, high = map(switch.at, explained.interval(f"{name}.{switch.name}"))
        factor = self.findings.log_bayes_factor(effects)
        return Cause(name, factor, amplitude, switch.unit, (low, high))

    def sizes_from_all_samples(self, named: Sequence[Effects]) -> tuple[Cause, ...]:
        """Return the named mechanisms refitted to both halves; empty without a second half, or where a fit fails.

        It judges nothing, since the half that judged is now fitted, too.
        """
        if self.unseen is None:
            return ()
        refits = ((effects, self.refit(effects)) for effects in named)
        return tuple(
            self._cause(refit, effects, name) for effects, refit in refits if refit for name in effects
        )

    @cached_property
    def whole(self) -> SphereProblem:
        """Both halves of the recording, as data."""
        return self.problem(self.recording if self.unseen is None else self.recording.merged(self.unseen))

    @cached_property
    def whole_context(self) -> FitContext:
        """Fits to both halves of the recording."""
        return FitContext(self.whole.data)

    @cached_property
    def _refits(self) -> dict[Effects, Explanation | None]:
        return {}

    def refit(self, effects: Effects) -> Explanation | None:
        """Return the explanation by these effects, fitted to both halves; None where its simulations fail."""
        if effects not in self._refits:
            added = tuple(self.library[name] for name in effects)
            start = self.findings.explanation(effects).fit.x
            self._refits[effects] = self.whole_context.explain(hypothesis(self.whole.model, added), start)
        return self._refits[effects]

    def problem(self, recording: Recording) -> SphereProblem:
        """Pose other samples of the heart to the same model within the same structure."""
        return SphereProblem.from_recording(recording, self.model.nominal, self.structure)

    def changes(self, effects: Effects) -> tuple[Change, ...]:
        """Return the clear changes since an earlier recording, given these effects, the clearest first."""
        if self.model.nominal.stands_for != "change":
            return ()
        posterior = self.findings.explanation(effects).posterior
        pairs = zip(posterior.mean, np.sqrt(np.diag(posterior.covariance)), strict=True)
        clear = [
            (abs(mean) / sd, _change(parameter, mean, sd))
            for parameter, (mean, sd) in zip(self.model.nominal.free, pairs, strict=False)
            if parameter is not FREE_PARAMETERS[TIME_SHIFT_INDEX] and abs(mean) > CLEAR_DEVIATIONS * sd
        ]
        return tuple(change for _, change in sorted(clear, key=lambda entry: -entry[0]))

    def far_parameters(self, effects: Effects) -> tuple[str, ...]:
        """One sentence for each parameter that was fitted, given these effects, far outside its prior."""
        fitted = zip(self.model.nominal.free, self.findings.explanation(effects).fit.x, strict=False)
        return tuple(
            f"{parameter.name} is fitted {x:+.1f} standard deviations from its expected value, expected at most "
            f"{FAR:g}: check {'that time zero is the R wave' if place == TIME_SHIFT_INDEX else 'units and columns'}"
            for place, (parameter, x) in enumerate(fitted)
            if abs(x) > FAR
        )

    def scale_notes(self) -> tuple[str, ...]:
        """One sentence for each scale that decides whether a mechanism is detected or named alone."""
        if self.verdict in ("two", "group", "unknown"):
            return ()
        at_scale = {
            single.effects[0]: partial(self._factor_at, single) for single in self.findings.survey.singles
        }
        return tuple(
            f"the finding depends on the scale of {case.name}: {case} (ln Bayes factors, detected from "
            f"{self.rules.detected:g}): compare the scale with the sizes that this mechanism has in patients"
            for case in scale_dependences(self.ranking(), at_scale, self.rules.detected, self.rules.group)
        )

    def _factor_at(self, single: Explanation, factor: float) -> float:
        """ln Bayes factor of a mechanism with its scale times a factor."""
        (name,) = single.effects
        coordinate = f"{name}.{self.library[name].unknowns[0].name}"
        return single.log_evidence_at_scale(coordinate, factor) - self.findings.evidences.baseline

    def ranking(self) -> dict[str, float]:
        """ln Bayes factors over the baseline, in descending order."""
        evidences = self.findings.evidences
        factors = {effects[0]: value - evidences.baseline for effects, value in evidences.singles.items()}
        factors["unknown"] = evidences.discrepancy - evidences.baseline
        return dict(sorted(factors.items(), key=lambda item: -item[1]))

    def traces(self, explained: Explanation) -> tuple[Trace, ...]:
        """One trace for each curve; noise: at the level that is most probable under the explanation."""
        data, baseline, best = self.data, self.findings.survey.baseline.fit, explained.fit
        levels, scale = Whitening.from_data(data).most_probable_levels(data.values - best.predicted)
        covariance = data.noise_covariance(levels)
        parts = zip(data.blocks, data.rows, self.findings.baseline_discrepancy, strict=True)
        return tuple(
            Trace(
                block.curve,
                block.times,
                data.values[rows],
                baseline.predicted[rows],
                best.predicted[rows],
                np.sqrt(np.diag(covariance)[rows]),
                lacking.mean,
                lacking.sd,
                None if data.structure is None else scale * np.sqrt(np.diag(data.structure)[rows]),
                deviation_of_means(
                    covariance[rows, rows], phase_names(block.times, block.period, self.phases)
                ),
            )
            for block, rows, lacking in parts
            if block.curve != BALANCE
        )

    def tried(self) -> tuple[FittedModel, ...]:
        """Every fitted model: without effects, with one, with two."""
        survey = self.findings.survey
        return tuple(map(_tried, (survey.baseline, *survey.singles, *survey.pairs)))

    @cached_property
    def phases(self) -> BeatPhases | None:
        """Phases of the baseline's beat; None where one of its valves never moves."""
        simulated = self.model.simulate(self.findings.survey.baseline.fit.x)
        if simulated is None:
            return None
        heart, beat = simulated
        try:
            return BeatPhases.from_curves(beat_curves(replace(beat, trigger=heart.trigger)))
        except ValueError:
            return None


def _change(parameter: FreeParameter, mean: float, sd: float) -> Change:
    nominal = 0.0 if parameter.additive else 1.0
    value, low, high = (
        parameter.at(nominal, float(mean + side * sd), "change") for side in (0.0, -1.96, 1.96)
    )
    return Change(parameter.name, value, (low, high), parameter.change_unit)


def _tried(explained: Explanation) -> FittedModel:
    """Summary of a fit, whose objective is -ln p(y | x) + |x|^2 / 2."""
    fit = explained.fit
    likelihood = fit.objective - 0.5 * float(fit.x @ fit.x)
    return FittedModel(explained.effects, explained.log_evidence, likelihood, fit.x.size)

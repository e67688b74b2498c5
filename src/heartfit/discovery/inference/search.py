"""The search for missing effects: baseline, single effects, pairs and the GP discrepancy, fitted to the same data.

All coordinates stay free under their priors in every hypothesis: the misfit of a coordinate held at a wrong value would
be attributed to an effect. Every fit starts at the prior mean with the effect switched on, not only at the baseline's
fit, which a strong effect drags to where the slopes no longer point at the cause. No hypothesis may fit worse than the
baseline, which it contains, and the baseline is fitted again from the best effect's coordinates: an improvement there
was no effect.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from heartfit.core.errors import InputError
from heartfit.discovery.inference.context import Discrepancy, FitContext, GPDiscrepancy
from heartfit.discovery.inference.data import Data
from heartfit.discovery.inference.decide import (
    DEFAULT_RULES,
    Decision,
    Effects,
    Evidences,
    Rules,
    decide,
    is_detected,
    is_explained,
    is_suspected,
)
from heartfit.discovery.inference.evidence import Explanation
from heartfit.discovery.inference.hypothesis import Hypothesis
from heartfit.discovery.inference.margin import Margin, margin
from heartfit.discovery.inference.predicted_evidence import (
    CombineEffects,
    best_prediction,
    fit_pairs,
    predict_placements,
)
from heartfit.discovery.inference.settling import rank, settle_leading

EQUAL_MARGIN = 0.05
"""Objective above the baseline's up to which an effect counts as its equal."""
CENTRE_PATIENCE = 50.0
"""Objective above that of the fit from the baseline up to which the fit from the prior mean goes on, its
slopes fresh.
"""
LEADING = 3
"""Number of best effects from whose fits the baseline starts again, and which start again from the baseline."""
FEW_PLACEMENTS = 3
"""Placements of an effect with one further unknown."""


@dataclass(frozen=True, eq=False)
class Survey:
    """The baseline, and singles and pairs in descending evidence; failed: effects without a completed simulation."""

    baseline: Explanation
    singles: tuple[Explanation, ...]
    pairs: tuple[Explanation, ...] = ()
    failed: tuple[Effects, ...] = ()

    def evidences(self, discrepancy: GPDiscrepancy) -> Evidences:
        """Their ln evidence and that of the discrepancy, added to the baseline and to the best."""
        best = [*self.singles[:1], *self.pairs[:1]]
        return Evidences(
            self.baseline.log_evidence,
            {single.effects: single.log_evidence for single in self.singles},
            discrepancy.log_evidence(self.baseline.fit),
            {explanation.effects: discrepancy.log_evidence(explanation.fit) for explanation in best},
            {pair.effects: pair.log_evidence for pair in self.pairs},
        )


def survey_singles(
    context: FitContext, baseline: Hypothesis, singles: Sequence[Hypothesis], rules: Rules
) -> Survey:
    """Fit the baseline and every single effect; refine the best effects where anything is suspected.

    A weak effect hardly changes the baseline's fit, and the slopes there lead on. A strong one drags that fit to where
    the slopes no longer point at the cause: so each effect also starts at the prior mean, strongly switched on, at the
    place and time of the largest predicted evidence.
    """
    at_mean, base = _fit_baseline(context, baseline)
    fits = {single.effects: _fit_single(context, base, at_mean, single, rules) for single in singles}
    completed = rank(explanation for explanation in fits.values() if explanation is not None)
    if not completed:
        raise InputError("search: no effect has a simulation that is completed; expected one at least")
    failed = tuple(effects for effects, explanation in fits.items() if explanation is None)
    survey = Survey(base, completed, failed=failed)
    rules = rules.beside_structure(_structural_scale(context, completed[0]))
    suspected = is_suspected(survey.evidences(context.discrepancy), rules)
    return _refine(context, at_mean, survey, rules) if suspected else survey


def _structural_scale(context: FitContext, explanation: Explanation) -> float:
    """The most probable scale of the structural covariance given an explanation."""
    return context.whitening.most_probable_levels(context.data.values - explanation.fit.predicted)[1]


def _fit_baseline(context: FitContext, baseline: Hypothesis) -> tuple[Explanation, Explanation]:
    """Return the baseline at the prior mean, and its fit, restarted once from its result."""
    at_mean = context.linearise(baseline, baseline.at(0.0))
    fitted = None if at_mean is None else context.explain(baseline, at_mean.fit.x, at_mean.fit.jacobian)
    if at_mean is None or fitted is None:
        raise InputError(
            "search: the simulation at the centre of the priors fails; expected one to start from"
        )
    return at_mean, context.improve(fitted, fitted.fit.x)


def _fit_single(
    context: FitContext, base: Explanation, at_mean: Explanation, hypothesis: Hypothesis, rules: Rules
) -> Explanation | None:
    from_base = fit_from_baseline(context, base, hypothesis)
    from_mean = _fit_from_prior_mean(context, at_mean, hypothesis, rules)
    if from_mean is None or from_base is None:
        return from_base or from_mean
    return context.improve(from_base, from_mean.fit.x, from_mean.fit.jacobian, patience=CENTRE_PATIENCE)


def _fit_from_prior_mean(
    context: FitContext, at_mean: Explanation, hypothesis: Hypothesis, rules: Rules
) -> Explanation | None:
    """An effect's best fit from the prior mean up to the first fresh slopes.

    The predicted evidence determines the starting side of one further unknown, but not of two (place and extent).
    """
    amplitudes = (rules.start_amplitude, rules.start_amplitude)
    predictions = predict_placements(context, at_mean, hypothesis, amplitudes)
    predictions.sort(key=lambda prediction: -prediction.log_evidence)
    starts = predictions if len(predictions) > FEW_PLACEMENTS else predictions[:1]
    fits = [context.explain(hypothesis, start.start, start.slopes, target=-np.inf) for start in starts]
    completed = (explanation for explanation in fits if explanation is not None)
    return min(completed, key=lambda explanation: explanation.fit.objective, default=None)


def fit_from_baseline(context: FitContext, base: Explanation, hypothesis: Hypothesis) -> Explanation | None:
    """Fit an effect from the end of the baseline's fit, with the baseline's slopes of the shared coordinates.

    A fit that ends above the baseline is repeated from exactly there.
    """
    prediction, shared = best_prediction(context, base, hypothesis), base.fit.x.size
    fitted = None if prediction is None else prediction.fit(context, shared)
    if prediction is None or fitted is None or _not_worse(fitted, base):
        return fitted
    start = hypothesis.at(0.0)
    start[:shared] = base.fit.x
    return context.improve(fitted, start, prediction.slopes, shared)


def _not_worse(single: Explanation, baseline: Explanation) -> bool:
    return single.fit.objective <= baseline.fit.objective + EQUAL_MARGIN


def _refine(context: FitContext, at_mean: Explanation, survey: Survey, rules: Rules) -> Survey:
    """Refit the best effects with fresh slopes and from all placements, and the baseline from the best effect.

    An effect that then fits worse than the baseline is fitted from the baseline again.
    """
    refitted = rank(_refit_fresh(context, single) for single in survey.singles[: rules.refitted])
    respread = [
        _refit_from_placements(context, at_mean, single, rules) for single in refitted[: rules.respread]
    ]
    singles = rank([*respread, *refitted[rules.respread :], *survey.singles[rules.refitted :]])
    baseline = survey.baseline
    for single in singles[:LEADING]:
        baseline = _refit_baseline(context, baseline, single)
    nested = [
        single
        if place >= LEADING and _not_worse(single, baseline)
        else _better(single, fit_from_baseline(context, baseline, single.fit.hypothesis))
        for place, single in enumerate(singles)
    ]
    return replace(survey, singles=rank(nested), baseline=baseline)


def _better(single: Explanation, other: Explanation | None) -> Explanation:
    return other if other is not None and other.fit.objective < single.fit.objective else single


def _refit_fresh(context: FitContext, single: Explanation) -> Explanation:
    return context.explain(single.fit.hypothesis, single.fit.x, single.fit.jacobian) or single


def _refit_from_placements(
    context: FitContext, at_mean: Explanation, single: Explanation, rules: Rules
) -> Explanation:
    amplitudes = (rules.start_amplitude, rules.start_amplitude)
    for prediction in predict_placements(context, at_mean, single.fit.hypothesis, amplitudes):
        single = context.improve(single, prediction.start)
    return single


def _refit_baseline(context: FitContext, base: Explanation, best: Explanation) -> Explanation:
    shared = base.fit.x.size
    return context.improve(base, best.fit.x[:shared], best.fit.jacobian[:, :shared])


def polish_best(context: FitContext, survey: Survey, rules: Rules) -> Survey:
    """Start the best effects again from other amplitudes."""
    best = [_polish_single(context, single, rules.polish) for single in survey.singles[: rules.polished]]
    return replace(survey, singles=rank([*best, *survey.singles[rules.polished :]]))


def _polish_single(context: FitContext, single: Explanation, amplitudes: Sequence[float]) -> Explanation:
    for amplitude in amplitudes:
        start = single.fit.hypothesis.at(amplitude)
        single = context.improve(single, start, single.fit.jacobian)
    return single


def settle_best(context: FitContext, survey: Survey, rules: Rules) -> Survey:
    """Settle the baseline and the leading singles and pairs, which a decision compares."""
    (baseline,) = settle_leading(context, (survey.baseline,), 1)
    singles, pairs = (settle_leading(context, fits, rules.settled) for fits in (survey.singles, survey.pairs))
    return replace(survey, baseline=baseline, singles=singles, pairs=pairs)


@dataclass(frozen=True, eq=False)
class Findings:
    """The decision and its grounds.

    baseline_discrepancy, discrepancy: estimated discrepancies of the baseline and of the explanation that the decision
    names; simulations: number of forward runs; rules: that were applied; structural_scale: the most probable scale of
    the structural covariance given the baseline, 0 where the model is trusted.
    """

    decision: Decision
    evidences: Evidences
    survey: Survey
    baseline_discrepancy: tuple[Discrepancy, ...]
    discrepancy: tuple[Discrepancy, ...]
    simulations: int
    rules: Rules = DEFAULT_RULES
    structural_scale: float = 0.0

    @property
    def best(self) -> Explanation:
        """The explanation that the decision names: the baseline where it names none."""
        return self.explanation(self.decision.effects)

    @property
    def margin(self) -> Margin | None:
        """The smallest change of one ln evidence that changes the decision; None where it is not close."""
        return margin(self.evidences, self.rules)

    def explanation(self, effects: Effects) -> Explanation:
        """The explanation by these effects; raises KeyError for effects that were not fitted."""
        fitted = (self.survey.baseline, *self.survey.singles, *self.survey.pairs)
        return {explanation.effects: explanation for explanation in fitted}[effects]

    def log_bayes_factor(self, effects: Effects) -> float:
        """ln evidence of these effects over the baseline."""
        return self.explanation(effects).log_evidence - self.survey.baseline.log_evidence


def search(
    data: Data,
    baseline: Hypothesis,
    singles: Sequence[Hypothesis],
    combine: CombineEffects,
    rules: Rules = DEFAULT_RULES,
) -> Findings:
    """Search for the effects that the baseline lacks to explain the data.

    combine gives the hypothesis of two effects, named in alphabetical order. Raises InputError where the simulation
    fails at the centre of the priors, or that of every effect.
    """
    context = FitContext(data)
    survey = settle_best(context, survey_singles(context, baseline, singles, rules), rules)
    scale = _structural_scale(context, survey.baseline)
    rules = rules.beside_structure(_structural_scale(context, survey.singles[0]))
    survey = _complete(context, survey, combine, rules)
    evidences = survey.evidences(context.discrepancy)
    decision = decide(evidences, rules)
    missing = context.discrepancy.curves(survey.baseline.fit)
    findings = Findings(decision, evidences, survey, missing, missing, context.simulations, rules, scale)
    return replace(findings, discrepancy=context.discrepancy.curves(findings.best.fit))


def _complete(context: FitContext, survey: Survey, combine: CombineEffects, rules: Rules) -> Survey:
    """The survey with other starts before the verdict "unknown", and with pairs where anything is detected."""
    evidences = survey.evidences(context.discrepancy)
    if not is_detected(evidences, rules):
        return survey
    if not is_explained(evidences, evidences.single, rules):
        survey = settle_best(context, polish_best(context, survey, rules), rules)
    pairs = rank(fit_pairs(context, survey.singles, combine, rules))
    return settle_best(context, replace(survey, pairs=pairs), rules)

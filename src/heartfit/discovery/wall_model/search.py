r"""The search for a missing effect in three dimensions, with the strain of the wall among the data.

The baseline, all unknowns free, is fitted with the slopes of a tangent-linear beat, which are renewed while the fit
moves, twice at most. Every mechanism, regional ones at six angles, is then switched on once, in beats with the time
step of derivatives; the secant ranks it by the evidence of the linear model. Only the best are fitted, from the
baseline's fit, one beat a step, the best of them once more with slopes of its own. They are judged by their evidence as
on the sphere, with the stricter rules: an effect needs a ln Bayes factor of ten and must beat the smooth discrepancies
of all curves.
"""

import time as clock
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.decide import STRICT_RULES, Decision, Evidences, decide
from heartfit.discovery.inference.evidence import Explanation, fit_from_slopes
from heartfit.discovery.inference.hypothesis import CountedHypothesis, Hypothesis
from heartfit.discovery.inference.predicted_evidence import PredictedEvidence, predict_evidence
from heartfit.discovery.inference.search import Survey
from heartfit.discovery.inference.settling import rank
from heartfit.discovery.sphere_model.forward_model import Candidate, hypothesis
from heartfit.discovery.wall_model.forward_model import WallForwardModel
from heartfit.discovery.wall_model.hypotheses import candidates, is_regional, placements
from heartfit.discovery.wall_model.unknowns import COORDINATES
from heartfit.discovery.wall_model.wall_data import WallRecording
from heartfit.roles import registered

RULES = STRICT_RULES
"""Controls of another mesh and other valves reach 8.7, see docs/decisions/search.md."""
BASELINE_STEPS, EFFECT_STEPS = (10, 8, 6), 8
"""Largest numbers of steps of the baseline, with its first and with renewed slopes, and of an effect."""
CONVERGED = 1.5
"""Distance of a fit from the heart with its slopes [prior sd] below which these are not renewed."""
SHORTEST = 0.1
"""Distance from a heart with slopes [prior sd] below which the way to a fit without them is not halved."""
REFITTED = 5
"""Number of placements of effects that are fitted."""
SUSPECTED = 2.0
"""Gain of the best fit over the baseline [ln Z] above which its slopes are renewed."""
LEAST_PREDICTED = 1.0
"""Predicted gain over the baseline [ln Z] below which an effect is not fitted."""
DIFFERENCE = 0.1
"""Step of the differences along the unknowns of an effect [prior sd]."""
STARTS = (0.5, 3.0)
"""Range of amplitudes at which an effect starts [scales]."""


@dataclass(frozen=True)
class Screened:
    """An effect at one placement: its ln Bayes factor by the linear model, and its detection limit [scales]."""

    effect: str
    log_bayes_factor: float
    limit: float


@dataclass(frozen=True, eq=False)
class WallFindings:
    """The decision and its grounds.

    screened: every effect at every placement that was tried, in descending evidence; beats, tangents: numbers of beats
    and of tangent-linear ones; cpu: [s].
    """

    decision: Decision
    evidences: Evidences
    survey: Survey
    screened: tuple[Screened, ...]
    beats: int
    tangents: int
    cpu: float

    @property
    def gains(self) -> dict[str, float]:
        """ln evidence of the best fit of each fitted effect over the baseline."""
        base = self.survey.baseline.log_evidence
        return {
            best.effects[0]: best.log_evidence - base for best in _one_for_each_effect(self.survey.singles)
        }

    @property
    def discrepancy(self) -> float:
        """ln evidence of smooth discrepancies added to the baseline, over the baseline's."""
        return self.evidences.discrepancy - self.survey.baseline.log_evidence

    @property
    def regional(self) -> str:
        """Name of the best effect of a region, empty if none was fitted."""
        return next((name for name in self.gains if is_regional(registered()[name])), "")

    @property
    def limits(self) -> dict[str, tuple[float, float]]:
        """Detection limits [scales] of the screened effects, at the placements that show the most and the least."""
        names = sorted({one.effect for one in self.screened})
        by_effect = {name: [one.limit for one in self.screened if one.effect == name] for name in names}
        return {name: (min(limits), max(limits)) for name, limits in by_effect.items()}

    def best(self, effect: str) -> Explanation:
        """The best fit of an effect; raises StopIteration if it was not fitted."""
        return next(single for single in self.survey.singles if single.effects == (effect,))

    def log_bayes_factor(self, effect: str) -> float:
        """ln evidence of the best fit of an effect over the baseline; -inf if it was not fitted."""
        return self.gains.get(effect, -np.inf)


def search_wall(
    model: WallForwardModel, recording: WallRecording, library: Sequence[Candidate] | None = None
) -> WallFindings:
    """Search for the effect that the nominal heart lacks to explain a recording with the strain of its wall.

    Raises InputError where the beat at the prior mean fails.
    """
    started, context = clock.process_time(), FitContext(recording.data())
    tried = candidates(model, recording.has_pressure) if library is None else list(library)
    base = _fit_baseline(context, model)
    lowest = base.log_evidence
    predictions = _predict_all(context, model, base, tried)
    best = [one for one in predictions if one.log_evidence > base.log_evidence + LEAST_PREDICTED]
    fits = [_fit_effect(context, one) for one in best[:REFITTED]]
    singles = rank(fitted for fitted in fits if fitted is not None)
    if singles and singles[0].log_evidence - base.log_evidence > SUSPECTED:
        singles = rank([_polish(context, model, singles[0], tried), *singles[1:]])
    base = _refit_baseline(context, base, singles)
    survey = Survey(base, _one_for_each_effect(singles) or (base,))
    evidences = survey.evidences(context.discrepancy)
    return WallFindings(
        decide(evidences, RULES),
        evidences,
        replace(survey, singles=singles),
        tuple(_screened(one, lowest) for one in predictions),
        model.simulations,
        model.tangents,
        clock.process_time() - started,
    )


def _screened(prediction: PredictedEvidence, baseline: float) -> Screened:
    """The prediction over the ln evidence of the baseline from which it was made."""
    name = prediction.hypothesis.effects[0]
    limit = prediction.detection_limit(RULES.detected)
    return Screened(name, prediction.log_evidence - baseline, limit)


def _fit_baseline(context: FitContext, model: WallForwardModel) -> Explanation:
    """The baseline's fit, its slopes renewed while it moves."""
    baseline, start = hypothesis(model), np.zeros(len(COORDINATES))
    x = start
    for steps in BASELINE_STEPS:
        start, tangent = _nearest_slopes(model, start, x)
        fitted = _fit(context, baseline, start, *tangent, steps)
        x = fitted.fit.x
        if np.linalg.norm(x - start) < CONVERGED:
            break
    return fitted


def _nearest_slopes(
    model: WallForwardModel, start: Floats, x: Floats
) -> tuple[Floats, tuple[Floats, Floats]]:
    """Coordinates of the heart with slopes, and these: at x, or where the way back to ``start`` is halved."""
    tangent = model.slopes(x)
    if tangent is not None:
        return x, tangent
    if np.linalg.norm(x - start) < SHORTEST:
        raise InputError("wall search: the beat of the baseline fails; expected one to start from")
    return _nearest_slopes(model, start, (x + start) / 2.0)


def _fit(
    context: FitContext, tried: Hypothesis, x: Floats, predicted: Floats, slopes: Floats, steps: int
) -> Explanation:
    fitted = fit_from_slopes(
        CountedHypothesis(tried), context.data.values, context.whitening, x, predicted, slopes, steps
    )
    return Explanation.from_fit(fitted, context.data.values, context.whitening)


def _predict_all(
    context: FitContext, model: WallForwardModel, base: Explanation, tried: Sequence[Candidate]
) -> list[PredictedEvidence]:
    """Predictions of all placements, in descending evidence, their secants between beats of long time steps."""
    longer, shared = model.with_long_steps(), np.zeros(len(COORDINATES))
    before = longer.predict(base.fit.x)
    screen, at_base = (model, base.fit.predicted) if before is None else (longer, before)
    predictions = [
        predict_evidence(
            context, base, hypothesis(screen, [effect]), np.concatenate([shared, place]), STARTS, at_base
        )
        for effect in tried
        for place in placements(effect)
    ]
    model.simulations += longer.simulations
    to_fit = {effect.name: hypothesis(model, [effect]) for effect in tried}
    completed = [
        replace(prediction, hypothesis=to_fit[prediction.hypothesis.effects[0]])
        for prediction in predictions
        if prediction is not None
    ]
    return sorted(completed, key=lambda prediction: -prediction.log_evidence)


def _polish(
    context: FitContext, model: WallForwardModel, best: Explanation, tried: Sequence[Candidate]
) -> Explanation:
    """The fit of an effect, continued with fresh slopes of all its unknowns."""
    x, b = best.fit.x, len(COORDINATES)
    (effect,) = (candidate for candidate in tried if (candidate.name,) == best.effects)
    tangent = model.slopes(x, [effect.at(x[b:])])
    if tangent is None:
        return best
    predicted, shared = tangent
    own = CountedHypothesis(best.fit.hypothesis).jacobian(x, predicted, b, DIFFERENCE)
    again = _fit(context, best.fit.hypothesis, x, predicted, np.column_stack([shared, own]), EFFECT_STEPS)
    return again if again.fit.objective < best.fit.objective else best


def _fit_effect(context: FitContext, prediction: PredictedEvidence) -> Explanation | None:
    """Fit of an effect from its prediction, with the slopes of its own unknowns there."""
    tried, x, b = prediction.hypothesis, prediction.start, len(COORDINATES)
    model = CountedHypothesis(tried)
    start = model.simulate_start(x)
    if start is None:
        return None
    x, predicted = start
    own = model.jacobian(x, predicted, b, DIFFERENCE)
    return _fit(context, tried, x, predicted, np.column_stack([prediction.slopes[:, :b], own]), EFFECT_STEPS)


def _refit_baseline(context: FitContext, base: Explanation, singles: Sequence[Explanation]) -> Explanation:
    """The baseline, fitted again from the coordinates of the best effect where that is better."""
    if not singles:
        return base
    best, b = singles[0].fit, len(COORDINATES)
    x = best.x[:b]
    predicted = base.fit.hypothesis.forward(x)
    if predicted is None:
        return base
    again = _fit(context, base.fit.hypothesis, x, predicted, best.jacobian[:, :b], EFFECT_STEPS)
    return again if again.fit.objective < base.fit.objective else base


def _one_for_each_effect(singles: Sequence[Explanation]) -> tuple[Explanation, ...]:
    """The best fit of each effect, in descending evidence."""
    return rank({single.effects: single for single in reversed(singles)}.values())

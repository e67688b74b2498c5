"""Predicted evidence of a further effect, from one simulation, and the search for a second effect.

The effect is switched on at its typical size; the secant takes the place of its slope in the linear model about one
fit. The prediction gives a start for the fit of both and ranks the candidates; it is no evidence itself, since the
response to a strong effect is not linear.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.decide import Effects, Rules
from heartfit.discovery.inference.evidence import LARGEST_INFORMED_VARIANCE, Explanation, posterior
from heartfit.discovery.inference.hypothesis import Hypothesis

START_AMPLITUDES = (0.3, 3.0)
"""Range of amplitudes at which a fit starts: the other unknowns of an effect matter only while it is on."""


@dataclass(frozen=True, eq=False)
class PredictedEvidence:
    """A hypothesis with a start (d,) and slopes (n, d) for its fit, and the ln Z of the linear model.

    variance: that the linear model leaves to the amplitude of the further effect, whose prior has 1.
    """

    hypothesis: Hypothesis
    start: Floats
    slopes: Floats
    log_evidence: float
    variance: float

    def detection_limit(self, threshold: float) -> float:
        r"""Amplitude a [scales] at which the linear model expects the ln Bayes factor to be ``threshold``.

        With the posterior variance v of the amplitude,

        .. math:: \ln B = \tfrac12 \ln v + \tfrac12 a^2 (1 - v)^2 / v ,

        and ln 2 more for a one-sided amplitude. Infinite where the data do not inform it.
        """
        if self.variance >= LARGEST_INFORMED_VARIANCE:
            return float(np.inf)
        added = [c.one_sided for c in self.hypothesis.coordinates if c.amplitude][-1] * np.log(2.0)
        needed = max(threshold - added - 0.5 * np.log(self.variance), 0.0)
        return float(np.sqrt(2.0 * needed * self.variance) / (1.0 - self.variance))

    def fit(self, context: FitContext, trusted: int = 0) -> Explanation | None:
        """Fit the hypothesis from the start; None where its simulations fail."""
        return context.explain(self.hypothesis, self.start, self.slopes, trusted)


def best_prediction(
    context: FitContext,
    fitted: Explanation,
    further: Hypothesis,
    amplitudes: tuple[float, float] = START_AMPLITUDES,
) -> PredictedEvidence | None:
    """The prediction of the largest evidence among the placements of an effect."""
    predictions = predict_placements(context, fitted, further, amplitudes)
    return max(predictions, key=lambda prediction: prediction.log_evidence, default=None)


def predict_placements(
    context: FitContext,
    fitted: Explanation,
    further: Hypothesis,
    amplitudes: tuple[float, float] = START_AMPLITUDES,
) -> list[PredictedEvidence]:
    """Predictions with the effect's other unknowns at their mean and one step to either side.

    Data depend so nonlinearly on the place and time of an effect that a fit stays on the side on which it starts.
    """
    predictions = [
        predict_evidence(context, fitted, further, placement, amplitudes)
        for placement in _placements(fitted, further)
    ]
    return [prediction for prediction in predictions if prediction is not None]


def _placements(fitted: Explanation, further: Hypothesis) -> list[Floats]:
    """Coordinates (d,) of the further effect's other unknowns: all at 0, then one of them at -1 or 1."""
    names = fitted.fit.hypothesis.names
    others = [
        index
        for index, coordinate in enumerate(further.coordinates)
        if not (coordinate.amplitude or coordinate.name in names)
    ]
    unit = np.eye(len(further.names))
    return [np.zeros(len(further.names)), *(sign * unit[i] for i in others for sign in (-1.0, 1.0))]


def predict_evidence(
    context: FitContext,
    fitted: Explanation,
    further: Hypothesis,
    placement: Floats | float = 0.0,
    amplitudes: tuple[float, float] = START_AMPLITUDES,
    before: Floats | None = None,
) -> PredictedEvidence | None:
    """The prediction for a hypothesis that adds one effect to a fitted one; None where its simulation fails.

    placement (d,): other unknowns of the effect; amplitudes: the least and the largest one to start from; before (n,):
    the prediction without the effect, where ``further`` simulates with other numerics than the fit.
    """
    old = np.array([further.names.index(name) for name in fitted.fit.hypothesis.names], dtype=np.int64)
    new = further.amplitudes & ~np.isin(np.arange(len(further.names)), old)
    x = np.zeros(len(further.names)) + placement
    x[old] = fitted.fit.x
    secant = _secant(context, further, x, new, fitted.fit.predicted if before is None else before)
    if secant is None:
        return None
    slopes = np.zeros((fitted.fit.predicted.size, x.size))
    slopes[:, old] = fitted.fit.jacobian
    slopes[:, new] = secant[:, None]
    residual = context.data.values - fitted.fit.predicted
    linear = posterior(context.whitening, x, residual, slopes, further.one_sided)
    sign = np.where(further.one_sided | (linear.mean > 0.0), 1.0, -1.0)
    start = np.where(new, sign * np.clip(sign * linear.mean, *amplitudes), x)
    variance = float(np.diag(linear.covariance)[new].max())
    return PredictedEvidence(further, start, slopes, linear.log_evidence, variance)


def _secant(
    context: FitContext, further: Hypothesis, x: Floats, new: np.ndarray, before: Floats
) -> Floats | None:
    """Change (n,) of the prediction per unit of the new amplitude, from amplitude 1 or, if that fails, the least."""
    for amplitude in (1.0, START_AMPLITUDES[0]):
        switched = context.simulate(further, np.where(new, amplitude, x))
        if switched is not None:
            return (switched - before) / amplitude
    return None


CombineEffects = Callable[[Effects], Hypothesis]
"""The hypothesis of two effects by their names."""


def fit_pairs(
    context: FitContext, singles: Sequence[Explanation], combine: CombineEffects, rules: Rules
) -> list[Explanation]:
    """Fit the pairs with the largest predicted gain over the best single effect."""
    least = singles[0].log_evidence + rules.predicted_gain
    predictions = _predict_pairs(context, singles, combine, rules.partners)
    promising = [prediction for prediction in predictions if prediction.log_evidence > least]
    promising.sort(key=lambda prediction: -prediction.log_evidence)
    fits = [prediction.fit(context) for prediction in promising[: rules.pairs]]
    return [explanation for explanation in fits if explanation is not None]


def _predict_pairs(
    context: FitContext, singles: Sequence[Explanation], combine: CombineEffects, partners: int
) -> list[PredictedEvidence]:
    """Predictions of all pairs with one of the best ``partners`` effects, from the better effect of each pair."""
    predictions: dict[Effects, PredictedEvidence | None] = {}
    for single in singles[:partners]:
        for other in singles:
            first, second = sorted((single.effects[0], other.effects[0]))
            if other is not single and (first, second) not in predictions:
                pair = combine((first, second))
                predictions[first, second] = predict_evidence(context, single, pair)
    return [prediction for prediction in predictions.values() if prediction is not None]

"""The predicted evidence of a linear model is exact; two present effects have more of it than one."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.data import Noise
from heartfit.discovery.inference.decide import Rules
from heartfit.discovery.inference.hypothesis import Coordinate, Hypothesis
from heartfit.discovery.inference.predicted_evidence import best_prediction, fit_pairs, predict_evidence
from tests.discovery.inference import oscillator
from tests.discovery.inference.linear import data, hypothesis, slopes

J = slopes(3)
FURTHER = hypothesis(J, Coordinate("a", one_sided=True, amplitude=True))
Y = J @ np.array([0.5, -1.0, 0.8])


def test_the_predicted_evidence_of_a_linear_model_is_exact_and_takes_one_simulation() -> None:
    context = FitContext(data(Y))
    base = context.explain(hypothesis(J[:, :2]), np.zeros(2))
    runs = context.simulations
    prediction = predict_evidence(context, base, FURTHER)
    assert context.simulations == runs + 1
    explanation = context.explain(FURTHER, FURTHER.at(1.0))
    assert prediction.log_evidence == pytest.approx(explanation.log_evidence, rel=1e-6)
    assert prediction.start[2] == pytest.approx(explanation.posterior.mean[2], rel=1e-6)


def test_an_absent_effect_starts_at_an_observable_amplitude() -> None:
    context = FitContext(data(-Y))
    base = context.explain(hypothesis(J[:, :2]), np.zeros(2))
    assert predict_evidence(context, base, FURTHER).start[2] == 0.3


def test_a_failing_typical_size_is_replaced_by_a_smaller_one() -> None:
    context = FitContext(data(Y))
    base = context.explain(hypothesis(J[:, :2]), np.zeros(2))
    whole = predict_evidence(context, base, FURTHER)
    half = predict_evidence(context, base, replace(FURTHER, forward=lambda x: J @ x if x[2] < 0.5 else None))
    assert half.slopes == pytest.approx(whole.slopes)
    assert predict_evidence(context, base, replace(FURTHER, forward=lambda x: None)) is None


@pytest.mark.parametrize("side", [-1.0, 0.0, 1.0])
def test_an_effect_starts_on_the_side_on_which_it_acts(side) -> None:
    """The second coordinate of the effect selects which of three columns it adds."""
    shapes = slopes(3, seed=5)
    coordinates = (*FURTHER.coordinates, Coordinate("place"))
    placed = Hypothesis(("a",), coordinates, lambda x: J[:, :2] @ x[:2] + x[2] * shapes[:, round(x[3]) + 1])
    context = FitContext(data(3.0 * shapes[:, int(side) + 1]))
    base = context.linearise(hypothesis(J[:, :2]), np.zeros(2))
    start = best_prediction(context, base, placed, (2.0, 2.0)).start
    assert start[2:] == pytest.approx([2.0, side])


def test_only_pairs_with_enough_predicted_evidence_are_fitted() -> None:
    truth = oscillator.combined(("delay", "pulse")).forward(np.array([0.5, 0.2, -0.3, 0.1, 2.0, 1.0]))
    context = FitContext(oscillator.observed(truth, 1))
    singles = [context.explain(single, single.at(1.0)) for single in oscillator.SINGLES]
    ranked = sorted(singles, key=lambda explanation: -explanation.log_evidence)
    (pair,) = fit_pairs(context, ranked, oscillator.combined, Rules(predicted_gain=10.0))
    assert pair.effects == ("delay", "pulse")
    assert fit_pairs(context, ranked, oscillator.combined, Rules(predicted_gain=1e6)) == []
    assert len(fit_pairs(context, ranked, oscillator.combined, Rules(predicted_gain=-1e6, pairs=3))) == 3


@pytest.mark.parametrize("one_sided", [True, False])
@pytest.mark.parametrize("threshold", [7.0, 10.0])
def test_an_effect_at_its_detection_limit_has_the_threshold_of_evidence(
    one_sided: bool, threshold: float
) -> None:
    further = hypothesis(J, Coordinate("a", one_sided=one_sided, amplitude=True))
    quiet = Noise((0.2,), 0.0, 0.0, discrepancy=0.5)
    sound = FitContext(data(np.zeros(len(J)), quiet))
    at_rest = predict_evidence(sound, sound.linearise(hypothesis(J[:, :2]), np.zeros(2)), further)
    limit = at_rest.detection_limit(threshold)
    context = FitContext(data(limit * J[:, 2], quiet))
    base = context.linearise(hypothesis(J[:, :2]), np.zeros(2))
    gained = predict_evidence(context, base, further).log_evidence - base.log_evidence
    assert gained == pytest.approx(threshold, abs=1e-3)


def test_an_effect_that_changes_nothing_has_no_detection_limit() -> None:
    context = FitContext(data(np.zeros(len(J))))
    base = context.linearise(hypothesis(J[:, :2]), np.zeros(2))
    hidden = np.column_stack([J[:, :2], J[:, 0]])  # what the first coordinate does, too
    faint = hypothesis(hidden, Coordinate("a", one_sided=True, amplitude=True))
    assert predict_evidence(context, base, faint).detection_limit(7.0) > 4.0
    silent = hypothesis(np.column_stack([J[:, :2], 0.0 * J[:, 0]]), Coordinate("a", amplitude=True))
    assert predict_evidence(context, base, silent).detection_limit(7.0) == np.inf

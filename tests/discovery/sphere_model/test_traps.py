"""Two sources of false alarms in a healthy heart and one of a miss, each beside the search that avoids it."""

from collections.abc import Sequence

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.decide import DEFAULT_RULES
from heartfit.discovery.inference.hypothesis import Hypothesis
from heartfit.discovery.inference.search import fit_from_baseline, survey_singles
from heartfit.discovery.sphere_model.forward_model import SphereForwardModel, candidates, hypothesis
from heartfit.discovery.sphere_model.free_parameters import FREE_PARAMETERS
from heartfit.discovery.sphere_model.nominal_heart import ADULT
from heartfit.discovery.sphere_model.recording import search_data
from heartfit.synthetic.campaign import PlantedPlan
from tests.discovery.sphere_model.hearts import healthy, recorded

pytestmark = pytest.mark.usefixtures("coarse_search")
CALIBRATED = ("cavity", "sigma_0", "mu", "c_1", "R_p", "k_RS", "k_ATP")
IS_CALIBRATED = np.array([parameter.name.rsplit(".", 1)[-1] in CALIBRATED for parameter in FREE_PARAMETERS])


@pytest.fixture(scope="module")
def context():
    recording = healthy(4)
    data = search_data(recording)
    model = SphereForwardModel(
        ADULT.scaled_to(recording), {block.curve: block.times for block in data.blocks}
    )
    return FitContext(data), model


def frozen(full: Hypothesis) -> Hypothesis:
    """Hypothesis with the uncalibrated parameters held at the prior's mean."""
    free = np.concatenate([IS_CALIBRATED, np.ones(len(full.coordinates) - IS_CALIBRATED.size, dtype=bool)])

    def forward(x: Floats) -> Floats | None:
        whole = np.zeros(free.size)
        whole[free] = x
        return full.forward(whole)

    kept = tuple(coordinate for coordinate, is_free in zip(full.coordinates, free, strict=True) if is_free)
    return Hypothesis(full.effects, kept, forward)


def best_bayes_factor(context: FitContext, hypotheses: Sequence[Hypothesis]) -> float:
    """ln evidence of the best effect over the baseline, which comes first."""
    none, *effects = (
        context.explain(candidate, candidate.at(float(bool(candidate.effects)))) for candidate in hypotheses
    )
    return max(explanation.log_evidence for explanation in effects) - none.log_evidence


def test_frozen_parameters_cause_a_false_alarm(context):
    judge, model = context
    library = candidates(model)
    effects = [library[name] for name in ("CatheterDelay", "CatheterOffset", "ImageTriggerDelay")]
    hypotheses = [hypothesis(model), *(hypothesis(model, (coordinate,)) for coordinate in effects)]
    assert best_bayes_factor(judge, hypotheses) < DEFAULT_RULES.detected
    assert (
        best_bayes_factor(judge, [frozen(coordinate) for coordinate in hypotheses])
        > 2.0 * DEFAULT_RULES.detected
    )


def test_the_residual_of_one_unscented_step_is_no_evidence(context):
    judge, model = context
    none = hypothesis(model)
    fitted = judge.explain(none, none.at(0.0)).fit.predicted
    assert chi_square(judge, one_step(judge, frozen(none))) > 3.0
    assert chi_square(judge, fitted) < 1.3


def one_step(judge: FitContext, model: Hypothesis) -> Floats:
    """Prediction after one unscented step from the nominal heart, with the mean slopes over 2 n + 1 sigma points."""
    n = len(model.coordinates)
    reach = np.sqrt(n)
    up, down = (
        np.array([model.forward(side * reach * row) for row in np.eye(n)]) / reach for side in (1.0, -1.0)
    )
    slopes = 0.5 * (up - down).T
    slope, gram = judge.whitening.normal(judge.data.values - model.forward(np.zeros(n)), slopes)
    return model.forward(np.linalg.solve(np.eye(n) + gram, slope))


def chi_square(judge: FitContext, predicted: Floats) -> float:
    """Squared whitened residual at its most likely level of noise, over the number of values."""
    residual = judge.data.values - predicted
    levels, _ = judge.whitening.most_probable_levels(residual)
    parts = zip(judge.whitening.roots, levels, judge.whitening.rows, strict=True)
    white = np.concatenate([roots[level] @ residual[rows] for roots, level, rows in parts])
    return float(np.mean(white**2))


def test_a_severe_leak_moves_the_baseline_fit_to_where_the_leak_is_not_observable():
    """Fits from there miss most of the evidence of the leak; fits from the prior mean do not."""
    recording = recorded(PlantedPlan(312, "single", ("MitralRegurgitation",), 3.0))
    data = search_data(recording)
    model = SphereForwardModel(
        ADULT.scaled_to(recording), {block.curve: block.times for block in data.blocks}
    )
    leak = hypothesis(model, (candidates(model)["MitralRegurgitation"],))
    judge = FitContext(data)
    none = judge.explain(hypothesis(model), hypothesis(model).at(0.0))
    dragged = fit_from_baseline(judge, none, leak)
    survey = survey_singles(judge, hypothesis(model), [leak], DEFAULT_RULES)
    assert survey.singles[0].log_evidence - dragged.log_evidence > 3.0 * DEFAULT_RULES.detected
    assert survey.singles[0].log_evidence - survey.baseline.log_evidence > 3.0 * DEFAULT_RULES.detected

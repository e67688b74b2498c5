"""Settled fits: one evidence on whichever side of a kink a fit has stopped, none of a gain that no step realises."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.data import Noise
from heartfit.discovery.inference.decide import DEFAULT_RULES
from heartfit.discovery.inference.evidence import Explanation, Fit
from heartfit.discovery.inference.hypothesis import Coordinate, CountedHypothesis, Hypothesis
from heartfit.discovery.inference.search import search
from heartfit.discovery.inference.settling import settle
from tests.discovery.inference import oscillator
from tests.discovery.inference.linear import TIMES, data

COORDINATES = TIMES.size // 2
NOISE = Noise((1.0,), 0.0, 0.0, 1.0)
SLOPE, KINK, PLACE = 10.0, 6.0, 0.5
BASE = tuple(Coordinate(f"z{index}") for index in range(COORDINATES))


def kinked(x: np.ndarray) -> np.ndarray:
    """Every coordinate has a sample that it moves, and one that it moves from ``PLACE`` on."""
    return np.concatenate([SLOPE * x, KINK * np.maximum(x - PLACE, 0.0)])


def problem(left: float) -> tuple[Hypothesis, FitContext]:
    """The kinked model, and data that it explains at the kink but for ``left`` in the samples of the kinks."""
    values = kinked(np.full(COORDINATES, PLACE)) + np.repeat([0.0, left], COORDINATES)
    return Hypothesis((), BASE, kinked), FitContext(data(values, NOISE))


def stopped(hypothesis: Hypothesis, context: FitContext, at: float) -> Explanation:
    """The explanation of a fit that has stopped with all coordinates there, by one-sided slopes."""
    x = np.full(COORDINATES, at)
    predicted = hypothesis.forward(x)
    jacobian = CountedHypothesis(hypothesis).jacobian(x, predicted)
    objective = 0.5 * float(x @ x) - context.whitening.log_likelihood(context.data.values - predicted)
    fit = Fit(hypothesis, x, predicted, jacobian, objective, converged=True)
    return Explanation.from_fit(fit, context.data.values, context.whitening)


def integral(left: float) -> float:
    """Return ln Z: the coordinates are independent."""

    def density(x: float) -> float:
        misfit = SLOPE * (PLACE - x), left - KINK * max(x - PLACE, 0.0)
        return float(norm.pdf(x) * norm.pdf(misfit[0]) * norm.pdf(misfit[1]))

    return COORDINATES * float(np.log(quad(density, -1.0, 2.0, points=[PLACE], epsabs=0.0)[0]))


def test_two_ends_beside_a_kink_have_one_evidence() -> None:
    """A one-sided slope takes the side on which the fit has stopped; the integral is between both."""
    hypothesis, context = problem(left=0.0)
    ends = [stopped(hypothesis, context, PLACE + side) for side in (-0.03, 0.01)]
    settled = [settle(context, end) for end in ends]
    assert abs(ends[0].log_evidence - ends[1].log_evidence) > 0.5
    assert settled[0].log_evidence == pytest.approx(settled[1].log_evidence, abs=0.01)
    assert settled[0].log_evidence == pytest.approx(integral(0.0), abs=0.15)


def test_a_gain_that_no_step_realises_is_no_evidence() -> None:
    hypothesis, context = problem(left=-2.0)
    end = stopped(hypothesis, context, PLACE)
    exact, settled = integral(-2.0), settle(context, end)
    assert 0.0 < settled.log_evidence - exact < 0.45 * (end.log_evidence - exact)
    assert end.fit.objective - settled.fit.objective < 0.01


def test_a_search_compares_settled_fits() -> None:
    findings = search(
        oscillator.observed(oscillator.curves(np.zeros(4)), 1),
        oscillator.NONE,
        oscillator.SINGLES,
        oscillator.combined,
    )
    compared = (findings.survey.baseline, *findings.survey.singles[: DEFAULT_RULES.settled])
    assert [explanation.fit.settled for explanation in compared] == [True] * 4

"""The expected gain of a further measurement is its average gain."""

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.data import Block, Noise
from heartfit.discovery.inference.evidence import Explanation
from heartfit.discovery.inference.hypothesis import Coordinate
from heartfit.discovery.inference.plan import FurtherMeasurement, divergence, evaluate, plan
from tests.discovery.inference.linear import TIMES, data, hypothesis

RAMP, ARCH = TIMES - 0.4, np.sin(np.pi * TIMES)
KNOWN = Noise((0.1,), 0.0, 0.05, discrepancy=0.5)
NEW = (Block("new", "m", TIMES, 1.0, KNOWN),)


def explained(name: str) -> Explanation:
    """Data with a ramp, explained by two effects that both produce this ramp."""
    matrix = np.column_stack([np.ones(TIMES.size), RAMP])
    effect = hypothesis(matrix, Coordinate(name, one_sided=True, amplitude=True))
    explanation = FitContext(data(2.0 * RAMP, KNOWN)).explain(effect, effect.at(1.0))
    assert explanation is not None
    return explanation


def measured_as(
    shapes: dict[str, np.ndarray], name: str = "new", cost: float = 1.0, own: int = 0
) -> FurtherMeasurement:
    """Measurement in which each effect has its own shape, with optional parameters of the measurement that shift it."""
    return FurtherMeasurement(
        name, cost, NEW, lambda effects: lambda x: x[1] * shapes[effects[0]] + 3.0 * x[2:].sum(), own
    )


OPPOSED = {"a": ARCH, "b": -ARCH}
EQUAL = {"a": ARCH, "b": ARCH}


def test_divergence_is_the_mean_log_ratio() -> None:
    random = np.random.default_rng(0)
    means, roots = random.standard_normal((2, 3)), random.standard_normal((2, 3, 3))
    covariances = roots @ np.swapaxes(roots, 1, 2) + np.eye(3)
    p, q = (
        multivariate_normal(mean, covariance) for mean, covariance in zip(means, covariances, strict=True)
    )
    draws = p.rvs(200_000, random_state=1)
    expected = np.mean(p.logpdf(draws) - q.logpdf(draws))
    assert divergence(means[0], covariances[0], means[1], covariances[1]) == pytest.approx(expected, rel=0.02)
    assert divergence(means[0], covariances[0], means[0], covariances[0]) == pytest.approx(0.0, abs=1e-12)


def test_a_repeated_measurement_adds_no_separation_and_a_different_one_does() -> None:
    group = [explained("a"), explained("b")]
    assert evaluate(group, measured_as(EQUAL)).gain == pytest.approx(0.0, abs=1e-9)
    assert evaluate(group, measured_as(OPPOSED)).gain > 3.0


def test_a_measurement_is_worth_what_it_adds_for_the_worst_pair() -> None:
    """It separates one of three explanations from the others and leaves these as they are."""
    group = [explained(name) for name in ("a", "b", "c")]
    assert evaluate(group[:2], measured_as(OPPOSED)).gain > 3.0
    assert evaluate(group, measured_as(OPPOSED | {"c": ARCH})).gain == pytest.approx(0.0, abs=1e-9)


def test_unknown_parameters_of_a_measurement_lower_its_expected_gain() -> None:
    group, flat = [explained("a"), explained("b")], {"a": np.ones(TIMES.size), "b": -np.ones(TIMES.size)}
    known, unknown = (evaluate(group, measured_as(flat, own=own)) for own in (0, 1))
    assert unknown.gain < 0.1 * known.gain


def test_the_cheapest_decisive_measurement_leads_and_failed_ones_are_excluded() -> None:
    group = [explained("a"), explained("b")]
    dead = FurtherMeasurement("dead", 0.1, NEW, lambda effects: lambda x: None)
    offered = [
        measured_as(OPPOSED, "dear", 5.0),
        measured_as(EQUAL, "vain", 0.5),
        dead,
        measured_as(OPPOSED, "cheap", 1.0),
    ]
    prospects = plan(group, offered)
    assert [prospect.name for prospect in prospects] == ["cheap", "dear", "vain"]
    assert prospects[0].simulations == 2 * 3

"""The interval of one amplitude is that of least squares, without shrinkage to 0."""

import numpy as np
import pytest

from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.data import Noise
from heartfit.discovery.inference.evidence import INTERVAL_WIDENING
from heartfit.discovery.inference.hypothesis import Coordinate
from tests.discovery.inference.linear import NOISE, TIMES, data, hypothesis, slopes

KNOWN = Noise((0.3,), NOISE.memory, NOISE.roughness, NOISE.discrepancy)


def test_the_interval_is_free_of_the_prior() -> None:
    J = slopes(1)
    y = 3.0 * J[:, 0] + 0.2 * np.random.default_rng(3).standard_normal(TIMES.size)
    effect = hypothesis(J, Coordinate("a", amplitude=True))
    explanation = FitContext(data(y, KNOWN)).explain(effect, effect.at(1.0))
    weighted = np.linalg.solve(KNOWN.covariance(TIMES, 1.0, 0.3), J[:, 0])
    information = weighted @ J[:, 0]
    middle, low, high = explanation.interval("a")
    assert middle == pytest.approx(weighted @ y / information, rel=1e-3)
    assert high - low == pytest.approx(2.0 * 1.96 * INTERVAL_WIDENING / np.sqrt(information), rel=1e-3)

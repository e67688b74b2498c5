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


@pytest.mark.parametrize("one_sided", [True, False])
@pytest.mark.parametrize("factor", [4.0, 0.25])
@pytest.mark.parametrize("amplitude", [3.0, 0.1, -0.4])
def test_another_scale_gives_the_evidence_of_a_fit_with_it(
    one_sided: bool, factor: float, amplitude: float
) -> None:
    """The model is linear and its noise known, so that both are exact."""
    J = slopes(3)
    y = J @ [0.5, -0.3, amplitude] + 0.2 * np.random.default_rng(3).standard_normal(TIMES.size)
    coordinate = Coordinate("a", one_sided=one_sided, amplitude=True)
    scaled = J * [1.0, 1.0, factor]
    context = FitContext(data(y, KNOWN))
    at_one, at_factor = (
        context.explain(effect, effect.at(1.0))
        for effect in (hypothesis(J, coordinate), hypothesis(scaled, coordinate))
    )
    assert at_one.log_evidence_at_scale("a", 1.0) == pytest.approx(at_one.log_evidence, abs=1e-9)
    assert at_one.log_evidence_at_scale("a", factor) == pytest.approx(at_factor.log_evidence, abs=2e-3)

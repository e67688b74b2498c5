"""The evidence of the GP discrepancy is a marginal density; its curve is the Gaussian process given the data."""

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from heartfit.discovery.inference.context import DISCREPANCY_SIZES, GPDiscrepancy
from heartfit.discovery.inference.data import Noise, Whitening
from heartfit.discovery.inference.evidence import fit
from heartfit.discovery.inference.hypothesis import CountedHypothesis
from tests.discovery.inference.linear import NOISE, TIMES, covariances, data, hypothesis, slopes

J = slopes(2)
K = NOISE.discrepancy_covariance(TIMES, TIMES, 1.0)
BUMP = np.exp(-0.5 * ((TIMES - 0.5) / 0.1) ** 2)


def fitted(values: np.ndarray, noise: Noise = NOISE) -> tuple[GPDiscrepancy, object]:
    recorded = data(values, noise)
    return GPDiscrepancy.from_data(recorded), fit(
        CountedHypothesis(hypothesis(J)), values, Whitening.from_data(recorded), np.zeros(2)
    )


def test_the_evidence_is_the_marginal_density_averaged_over_sizes_and_levels() -> None:
    values = J @ np.array([0.5, -1.0]) + BUMP
    discrepancy, fitted_model = fitted(values)
    exact = [
        multivariate_normal(cov=noise + size**2 * K + J @ J.T).pdf(values)
        for noise in covariances()
        for size in DISCREPANCY_SIZES
    ]
    assert discrepancy.log_evidence(fitted_model) == pytest.approx(np.log(np.mean(exact)), rel=1e-9)


def test_the_curve_is_that_of_the_process_given_the_data() -> None:
    """Against the joint Gaussian of discrepancy and data, conditioned by its blocks, of one level and any size."""
    values, known = J @ np.array([0.5, -1.0]) + BUMP, Noise((0.3,), 0.1, 0.1, discrepancy=0.5)
    discrepancy, fitted_model = fitted(values, known)
    (curve,) = discrepancy.curves(fitted_model)
    candidates = []
    for size in DISCREPANCY_SIZES:
        total = known.covariance(TIMES, 1.0, 0.3) + size**2 * K + J @ J.T
        gain = size**2 * K @ np.linalg.inv(total)
        candidates.append((gain @ values, np.sqrt(np.diag(size**2 * K - gain @ (size**2 * K)))))
    distance = [np.abs(curve.mean - mean).max() + np.abs(curve.sd - sd).max() for mean, sd in candidates]
    assert min(distance) < 1e-9


def test_a_bump_is_located() -> None:
    tight = Noise((0.05,), 0.0, 0.02, discrepancy=0.5)
    discrepancy, fitted_model = fitted(BUMP, tight)
    (curve,) = discrepancy.curves(fitted_model)
    assert TIMES[np.argmax(curve.mean)] == 0.5
    assert curve.mean.max() > 2.0 * curve.sd[np.argmax(curve.mean)]

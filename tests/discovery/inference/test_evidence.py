"""The evidence of a linear model is the exact integral, at every point of evaluation."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import multivariate_normal, norm

from heartfit.discovery.inference.data import Whitening
from heartfit.discovery.inference.evidence import posterior
from tests.discovery.inference.linear import TIMES, covariances, data, slopes

Y = np.random.default_rng(5).standard_normal(TIMES.size)


def taken_at(x: np.ndarray, matrix: np.ndarray, one_sided: list[bool]) -> object:
    whitening = Whitening.from_data(data(Y))
    return posterior(whitening, x, Y - matrix @ x, matrix, np.array(one_sided))


@pytest.mark.parametrize("x", [np.zeros(3), np.array([1.0, -2.0, 0.5])])
def test_the_evidence_is_the_marginal_density_averaged_over_the_levels(x) -> None:
    J = slopes(3)
    exact = [multivariate_normal(cov=noise + J @ J.T).pdf(Y) for noise in covariances()]
    assert taken_at(x, J, [False] * 3).log_evidence == pytest.approx(np.log(np.mean(exact)), rel=1e-9)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_one_sided_evidence_is_the_integral_over_the_half_line(sign) -> None:
    """Includes data that pull the amplitude below its bound."""
    J = slopes(1) * sign

    def density(a: float) -> float:
        return (
            2.0
            * norm.pdf(a)
            * np.mean([multivariate_normal(J[:, 0] * a, covariance).pdf(Y) for covariance in covariances()])
        )

    exact = quad(density, 0.0, 8.0, epsabs=0.0, epsrel=1e-8)[0]
    assert taken_at(np.zeros(1), J, [True]).log_evidence == pytest.approx(np.log(exact), rel=1e-6)


def test_an_unobserved_amplitude_leaves_the_evidence_unchanged() -> None:
    J = slopes(3)
    J[:, 2] = 0.0
    without = taken_at(np.zeros(2), J[:, :2], [False] * 2).log_evidence
    for one_sided in (False, True):
        with_it = taken_at(np.zeros(3), J, [False, False, one_sided]).log_evidence
        assert with_it == pytest.approx(without, abs=1e-12)


def test_mean_and_covariance_are_those_of_the_mixture_of_levels() -> None:
    J, laplace = slopes(2), taken_at(np.array([0.3, 0.1]), slopes(2), [False] * 2)
    weights = np.array([multivariate_normal(cov=noise + J @ J.T).pdf(Y) for noise in covariances()])
    weights /= weights.sum()
    inverses = [np.linalg.inv(np.eye(2) + J.T @ np.linalg.solve(noise, J)) for noise in covariances()]
    means = [
        inverse @ J.T @ np.linalg.solve(noise, Y)
        for inverse, noise in zip(inverses, covariances(), strict=True)
    ]
    assert laplace.mean == pytest.approx(weights @ means, rel=1e-9)
    assert laplace.covariance == pytest.approx(np.tensordot(weights, inverses, 1), rel=1e-9)

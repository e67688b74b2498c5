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


@pytest.mark.parametrize("alike", [0.0, 0.95, -0.95])
@pytest.mark.parametrize("sizes", [(1.0, 1.0), (0.5, -0.5), (-1.0, 0.2), (-0.6, -0.6), (2.0, -1.5)])
def test_two_one_sided_amplitudes_have_the_evidence_of_their_quadrant(
    sizes: tuple[float, float], alike: float
) -> None:
    """Beside a free unknown, where data pull one or both below 0, and effects that look alike or opposite."""
    free, first, second = slopes(3).T
    J = np.column_stack([free, first, alike * first + np.sqrt(1.0 - alike**2) * second])
    y = J @ np.array([0.4, *sizes])
    values, step = np.linspace(0.0, 6.0, 601, retstep=True)
    weight = np.where(np.arange(601) % 2, 4.0, 2.0) * step / 3.0
    weight[[0, -1]] = step / 3.0
    pairs = np.stack(np.meshgrid(values, values, indexing="ij"), axis=-1)
    prior = 4.0 * norm.pdf(pairs).prod(axis=-1)
    likelihood = np.mean(
        [
            multivariate_normal(y, noise + np.outer(free, free)).pdf(pairs @ J[:, 1:].T)
            for noise in covariances()
        ],
        axis=0,
    )
    exact = weight @ (prior * likelihood) @ weight
    taken = posterior(Whitening.from_data(data(y)), np.zeros(3), y, J, np.array([False, True, True]))
    assert taken.log_evidence == pytest.approx(np.log(exact), abs=0.01)


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

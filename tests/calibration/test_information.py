"""The information gained equals the resolution of the linear-Gaussian problem."""

import numpy as np
import pytest

from heartfit.calibration.gaussian import Gaussian, information
from heartfit.calibration.unscented import sigma_points
from heartfit.calibration.update import Posterior, calibrate

SD = np.array([0.3, 0.2, 0.1])


def prior(correlation: float = 0.0) -> Gaussian:
    shape = np.eye(3)
    shape[0, 1] = shape[1, 0] = correlation
    return Gaussian(("a", "b", "c"), np.array([1.0, 2.0, 3.0]), np.outer(SD, SD) * shape)


def posterior_of(before: Gaussian, a: np.ndarray, noise: float, truth: np.ndarray) -> Posterior:
    """The posterior of z = A x at the truth, without a draw of the noise."""
    names = [f"z{row}" for row in range(len(a))]
    outcomes = [dict(zip(names, a @ point.z, strict=True)) for point in sigma_points(before)]
    return calibrate(before, outcomes, dict(zip(names, a @ truth, strict=True)), noise**2 * np.eye(len(a)))


def test_one_observation_removes_the_variance_given_by_the_signal_to_noise_ratio():
    posterior = posterior_of(prior(), np.array([[1.0, 0.0, 0.0]]), 0.15, np.zeros(3))
    informed = information(posterior.prior, posterior.estimate)
    assert informed.reduction == pytest.approx([0.3**2 / (0.3**2 + 0.15**2), 0.0, 0.0], abs=1e-12)
    assert informed.sd_ratio == pytest.approx([np.sqrt(0.2), 1.0, 1.0])
    assert (informed.rank, informed.degrees) == (1, pytest.approx(0.8))
    assert np.abs(informed.informed[:, 0]) == pytest.approx([1.0, 0.0, 0.0], abs=1e-12)


def test_an_observed_sum_informs_the_sum_and_not_the_difference():
    posterior = posterior_of(prior(), np.array([[1.0, 1.0, 0.0]]), 1e-6, np.zeros(3))
    informed = information(posterior.prior, posterior.estimate)
    assert np.abs(informed.informed[:, 0]) == pytest.approx(
        np.array([3.0, 2.0, 0.0]) / np.sqrt(13.0), abs=1e-6
    )
    assert informed.weakest.max() == pytest.approx(np.abs(informed.weakest).max())
    assert informed.share(np.array([2.0, -3.0, 1.0])) == pytest.approx(0.0, abs=1e-9)
    assert informed.share(np.array([3.0, 2.0, 0.0])) == pytest.approx(1.0)
    assert np.isnan(informed.share(np.zeros(3)))


@pytest.mark.parametrize("correlation", [0.0, 0.6])
def test_the_resolution_is_what_the_estimate_shows_of_the_truth(correlation):
    before = prior(correlation)
    a = np.array([[1.0, 0.5, 0.0], [0.2, -1.0, 0.4]])
    truth = before.mean + np.array([0.2, -0.1, 0.05])
    posterior = posterior_of(before, a, 0.1, truth)
    informed = information(before, posterior.estimate)
    inverse = np.linalg.inv(np.linalg.cholesky(before.covariance))
    shown = inverse @ (posterior.estimate.mean - before.mean)
    assert shown == pytest.approx(informed.resolution @ inverse @ (truth - before.mean), rel=1e-9)
    assert informed.degrees == pytest.approx(
        np.trace(np.eye(3) - posterior.estimate.covariance @ np.linalg.inv(before.covariance))
    )


def test_shrinkage_is_undone_in_observed_directions():
    before = prior()
    truth = before.mean + np.array([0.3, 0.2, 0.3])
    posterior = posterior_of(before, np.array([[1.0, 0.0, 0.0], [0.0, 0.1, 0.0]]), 0.1, truth)
    informed = information(before, posterior.estimate)
    shrunk = (posterior.estimate.mean - before.mean) / before.sd
    assert shrunk[0] == pytest.approx(0.9)
    assert informed.unshrunk(shrunk) == pytest.approx([1.0, 0.0, 0.0], abs=1e-9), (
        "b is hardly informed, c not at all"
    )


def test_mismatched_parameters_are_refused():
    with pytest.raises(ValueError, match="same"):
        information(prior(), prior().marginal(["a", "c"]))

"""Parameters are transformed to logarithms and back; an invalid prior is refused."""

import numpy as np
import pytest

from heartfit.calibration.gaussian import Gaussian


def test_round_trip() -> None:
    values = {"sigma_0": 240e3, "mu": 7e3, "R_p": 1.14e8}
    prior = Gaussian.from_relative(values, {"sigma_0": 0.2, "mu": 0.3, "R_p": 0.1})
    assert prior.physical() == pytest.approx(values)
    assert prior.sd == pytest.approx([0.2, 0.3, 0.1])


@pytest.mark.parametrize(
    ("mean", "sd", "message"),
    [
        ({"mu": -1.0}, {"mu": 0.2}, r"mean\b.*\bmu\b.*-1\.0"),
        ({"mu": 7e3}, {"mu": 0.0}, r"relative_sd\b.*\bmu\b.*\b0\.0"),
        ({"mu": 7e3}, {"nu": 0.2}, r"\['mu'\].*\['nu'\]"),
    ],
)
def test_an_invalid_prior_is_refused(mean: dict[str, float], sd: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Gaussian.from_relative(mean, sd)


def test_an_indefinite_covariance_is_refused() -> None:
    with pytest.raises(ValueError, match="not positive definite"):
        Gaussian(("a", "b"), np.zeros(2), np.array([[1.0, 2.0], [2.0, 1.0]]))


def test_a_marginal_keeps_mean_and_covariance_in_the_order_asked():
    covariance = np.array([[4.0, 1.0, 0.5], [1.0, 3.0, 0.2], [0.5, 0.2, 2.0]])
    whole = Gaussian(("a", "b", "c"), np.array([1.0, 2.0, 3.0]), covariance)
    part = whole.marginal(["c", "a"])
    assert part.names == ("c", "a")
    assert part.mean.tolist() == [3.0, 1.0]
    assert part.covariance.tolist() == [[2.0, 0.5], [0.5, 4.0]]

"""Fixed parameters are noise of the model: their covariance is that of the observations they change."""

import numpy as np
import pytest

from heartfit.calibration.sensitivity import covariance_of_fixed


def test_the_covariance_is_that_of_a_linear_map() -> None:
    rng = np.random.default_rng(0)
    slopes, sds = rng.standard_normal((5, 3)), rng.uniform(0.1, 0.3, 5)
    changes = (sds * rng.standard_normal((200_000, 5))) @ slopes
    assert covariance_of_fixed(slopes, sds) == pytest.approx(np.cov(changes.T), abs=0.01)


def test_without_fixed_parameters_there_is_no_noise() -> None:
    assert (covariance_of_fixed(np.empty((0, 3)), np.empty(0)) == np.zeros((3, 3))).all()


@pytest.mark.parametrize(
    ("slopes", "sds", "message"),
    [
        (np.ones((2, 3)), np.ones(3), r"slopes \(2, 3\), deviations \(3,\)"),
        (np.array([[np.nan]]), np.ones(1), "not finite"),
    ],
)
def test_mismatched_shapes_are_refused(slopes: np.ndarray, sds: np.ndarray, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        covariance_of_fixed(slopes, sds)

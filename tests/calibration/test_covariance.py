"""Sensitivities are exact for an observation that is linear in the logarithms, with failed beats or without."""

from collections.abc import Mapping

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.sensitivity import Sensitivity, one_at_a_time_scaling, sensitivity
from heartfit.calibration.unscented import CalibrationError, Outcome, sigma_points

SD = np.array([0.2, 0.3, 0.1])
SLOPES = np.array([[2.0, -1.0], [0.5, 4.0], [0.0, 3.0]])
CENTRE = np.array([5.0, -7.0])
NAMES = ("V_min", "q_min")


def prior_of(sd: np.ndarray) -> Gaussian:
    return Gaussian(("a", "b", "c"), np.array([1.0, 2.0, 3.0]), np.diag(sd**2))


def linear(z: np.ndarray) -> Outcome:
    values = CENTRE + (z - prior_of(SD).mean) @ SLOPES
    return dict(zip(NAMES, values.tolist(), strict=True)) | {"EF": 0.6}


def sensitivity_of(
    sd: np.ndarray = SD, step: float = 1.0, lost: Mapping[int, str] | None = None
) -> Sensitivity:
    prior, scaling = prior_of(sd), one_at_a_time_scaling(3, step)
    points = sigma_points(prior, scaling)
    outcomes = [(lost or {}).get(point.index, linear(point.z)) for point in points]
    return sensitivity(prior, points, outcomes, scaling, NAMES)


def test_points_lie_at_the_step_and_not_at_root_n() -> None:
    plus = sigma_points(prior_of(SD), one_at_a_time_scaling(3, 0.5))[1]
    assert plus.z - prior_of(SD).mean == pytest.approx([0.1, 0.0, 0.0])


@given(step=some.floats(0.1, 3.0))
def test_squares_are_shares_of_the_variance_for_any_step(step: float) -> None:
    changes = SD[:, None] * SLOPES
    result = sensitivity_of(step=step)
    assert result.covariance == pytest.approx(changes / np.linalg.norm(changes, axis=0))
    assert (result.covariance**2).sum(axis=0) == pytest.approx([1.0, 1.0])
    assert result.slopes == pytest.approx(SLOPES / CENTRE)


@pytest.mark.parametrize("lost", [0, 2, 6])
def test_a_failed_beat_is_mirrored_and_named(lost: int) -> None:
    result = sensitivity_of(lost={lost: "inverted"})
    assert result.covariance == pytest.approx(sensitivity_of().covariance)
    assert result.slopes == pytest.approx(sensitivity_of().slopes)
    assert [name.partition(" ")[2] for name in result.failed] == ["(inverted)"]


def test_a_parameter_without_beats_is_refused() -> None:
    with pytest.raises(CalibrationError, match=r"b\+ \(cold\).*b- \(hot\)"):
        sensitivity_of(lost={2: "cold", 5: "hot"})


def test_an_observation_without_sensitivity_is_refused() -> None:
    prior, scaling = prior_of(SD), one_at_a_time_scaling(3, 1.0)
    points = sigma_points(prior, scaling)
    with pytest.raises(CalibrationError, match=r"parameter.*\bEF\b"):
        sensitivity(prior, points, [linear(point.z) for point in points], scaling, (*NAMES, "EF"))


def test_rescaled_deviations_equal_a_draw_with_them() -> None:
    other = np.array([0.1, 0.1, 0.4])
    assert sensitivity_of().with_sd(other.tolist()).covariance == pytest.approx(
        sensitivity_of(other).covariance
    )
    assert sensitivity_of().with_sd(other.tolist()).prior.sd == pytest.approx(other)


def test_columns_are_taken_by_name() -> None:
    assert sensitivity_of().of(["q_min"]) == pytest.approx(sensitivity_of().covariance[:, 1:])

"""Interval of the ratio of two models' errors: its closed form, its coverage, and the gains that it finds."""

import numpy as np
import pytest
from scipy.stats import f

from heartfit.discovery.inference.error_ratio import error_ratio

HEARTS = 400


def errors(times: np.ndarray, correlation: float, ratio: float, seed: int) -> np.ndarray:
    """Errors (hearts, 2, k) that share half of their course, correlated by so much over a unit of time."""
    rng = np.random.default_rng(seed)
    lags = np.abs(times[:, None] - times)
    root = np.linalg.cholesky(correlation**lags if correlation else np.eye(times.size))
    own, extended = (rng.standard_normal((HEARTS, times.size)) @ root.T for _ in range(2))
    return np.stack([0.5 * extended + np.sqrt(0.75) * own, ratio * extended], axis=1)


def intervals(times: np.ndarray, drawn: np.ndarray) -> np.ndarray:
    return np.array([error_ratio(times, *one)[1] for one in drawn])


FRAMES, EVERY_FRAME = np.arange(12.0), np.arange(25.0)
PRESSURE = np.concatenate([np.arange(4.0) + 8.0 * block for block in range(10)])


@pytest.mark.parametrize(
    ("times", "correlation"),
    [(FRAMES, 0.0), (FRAMES, 0.4), (FRAMES, 0.7), (EVERY_FRAME, 0.0), (EVERY_FRAME, 0.7), (PRESSURE, 0.4)],
)
@pytest.mark.parametrize("ratio", [1.0, 0.5])
def test_the_interval_holds_the_ratio_in_93_of_100_hearts(
    times: np.ndarray, correlation: float, ratio: float
) -> None:
    """And calls equal models better in 4 at most."""
    low, high = intervals(times, errors(times, correlation, ratio, seed=11)).T
    assert np.mean((low <= ratio) & (ratio <= high)) >= 0.93
    assert np.mean(high < ratio) < 0.04


@pytest.mark.parametrize(
    ("times", "correlation"), [(EVERY_FRAME, 0.0), (EVERY_FRAME, 0.4), (PRESSURE, 0.0), (PRESSURE, 0.7)]
)
def test_half_the_error_is_called_better_in_four_of_five(times: np.ndarray, correlation: float) -> None:
    assert np.mean(intervals(times, errors(times, correlation, 0.5, seed=12))[:, 1] < 1.0) >= 0.8


def test_many_independent_errors_have_the_interval_of_fisher() -> None:
    """The F distribution is exact for errors that share nothing."""
    rng, times = np.random.default_rng(3), np.arange(400.0)
    baseline, extended = rng.standard_normal((2, 400))
    ratio, (low, high) = error_ratio(times, baseline, 0.5 * extended)
    assert ratio == pytest.approx(0.5 * np.sqrt(np.mean(extended**2) / np.mean(baseline**2)))
    reach = np.sqrt(f(400, 400).ppf(0.975))
    assert (low, high) == pytest.approx((ratio / reach, ratio * reach), rel=0.02)


def test_errors_that_are_the_same_have_the_ratio_one() -> None:
    error = np.sin(np.arange(40.0))
    ratio, interval = error_ratio(np.arange(40.0), error, error)
    assert (ratio, *interval) == pytest.approx((1.0, 1.0, 1.0))


def test_neither_order_nor_unit_matters() -> None:
    drawn, order = errors(FRAMES, 0.3, 0.7, 4)[0], np.random.default_rng(0).permutation(12)
    ratio, interval = error_ratio(1e-3 * FRAMES[order], *(1e-6 * drawn[:, order]))
    assert (ratio, *interval) == pytest.approx(
        (error_ratio(FRAMES, *drawn)[0], *error_ratio(FRAMES, *drawn)[1])
    )


def test_segments_that_repeat_each_other_add_nothing() -> None:
    """Independent ones narrow the interval, copies of one do not."""
    first, others = errors(EVERY_FRAME, 0.2, 0.8, 5)[0], errors(EVERY_FRAME, 0.2, 0.8, 6)[:4]
    times = np.repeat(EVERY_FRAME, 4)
    alone = error_ratio(EVERY_FRAME, *first)[1]
    copied = error_ratio(times, *np.repeat(first, 4, axis=1))[1]
    separate = error_ratio(times, *np.moveaxis(others, 0, -1).reshape(2, -1))[1]
    assert np.log(copied[1] / copied[0]) == pytest.approx(np.log(alone[1] / alone[0]), rel=0.05)
    assert np.log(separate[1] / separate[0]) < 0.7 * np.log(alone[1] / alone[0])

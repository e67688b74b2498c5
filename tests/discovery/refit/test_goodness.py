"""Chi-squared of each curve about a linear model: n - k degrees of freedom, and p at its nominal rate over hearts."""

import numpy as np
import pytest
from scipy.stats import binomtest

from heartfit.core.arrays import Floats
from heartfit.discovery.refit.goodness import curve_fits
from heartfit.discovery.refit.refit import Refit
from heartfit.discovery.refit.target import Target
from heartfit.discovery.sphere_model.cause import CurveFit
from heartfit.discovery.sphere_model.recording import Samples

COUNTS = {"lv_volume": 16, "rv_volume": 24}
TOTAL = sum(COUNTS.values())
FITTED = np.concatenate([np.arange(count) % 2 == 0 for count in COUNTS.values()])


def noise() -> Floats:
    """Errors that go together within a curve, and not between curves; 2 and 5 in size."""
    blocks = np.repeat(np.arange(2), list(COUNTS.values()))
    lags = np.abs(np.subtract.outer(np.arange(TOTAL), np.arange(TOTAL)))
    sd = np.where(blocks == 0, 2.0, 5.0)
    return np.outer(sd, sd) * np.exp(-lags / 1.5) * (blocks[:, None] == blocks)


def target(values: Floats, kept: np.ndarray, covariance: Floats) -> Target:
    """The kept rows (m,) of both curves."""
    ends = np.cumsum([0, *COUNTS.values()])
    samples = {
        name: Samples(np.flatnonzero(kept[rows]) / 50.0, values[rows][kept[rows]])
        for name, rows in zip(COUNTS, map(slice, ends[:-1], ends[1:]), strict=True)
    }
    return Target(samples, covariance[np.ix_(kept, kept)])


def fits_of(
    values: Floats, slopes: Floats, fitted: np.ndarray = FITTED, covariance: Floats | None = None
) -> list[CurveFit]:
    """Chi-squared of the model y = A x about its estimate from the fitted rows."""
    R = noise() if covariance is None else covariance
    data, complete = target(values, fitted, R), target(values, np.ones(TOTAL, bool), R)
    slope, gram = data.normal(values[fitted], slopes[fitted])
    C = np.linalg.inv(np.eye(slopes.shape[1]) + gram)
    x = C @ slope
    names = tuple(map(str, range(x.size)))
    known = 0.0, 0.0, 0.0, int(fitted.sum()), 1, True, slopes[fitted] @ x, slopes[fitted]
    return list(curve_fits(Refit(names, x, C, {}, *known, slopes), data, complete, slopes @ x))


def slopes_of(size: float, count: int = 7) -> Floats:
    return size * np.random.default_rng(5).standard_normal((TOTAL, count))


def test_parameters_without_a_prior_take_one_degree_of_freedom_each_from_the_curve_that_shows_them() -> None:
    values, slopes = np.random.default_rng(0).standard_normal(TOTAL), slopes_of(1e4)
    slopes[: COUNTS["lv_volume"]] = 0.0
    left, right = fits_of(values, slopes, np.ones(TOTAL, bool), np.eye(TOTAL))
    residual = values - slopes @ np.linalg.lstsq(slopes, values, rcond=None)[0]
    assert (left.freedom, right.freedom) == pytest.approx((16, 24 - 7), rel=1e-6)
    assert left.chi_squared == pytest.approx(values[:16] @ values[:16])
    assert right.chi_squared == pytest.approx(residual[16:] @ residual[16:], rel=1e-6)


@pytest.mark.parametrize("size", [0.5, 5.0, 100.0])
def test_a_right_model_is_below_five_per_cent_in_five_per_cent_of_hearts(size: float) -> None:
    rng, slopes, root = np.random.default_rng(3), slopes_of(size), np.linalg.cholesky(noise())
    drawn = [
        fits_of(slopes @ rng.standard_normal(7) + root @ rng.standard_normal(TOTAL), slopes)
        for _ in range(300)
    ]
    for p in np.array([[fit.p for fit in fits] for fits in drawn]).T:
        assert binomtest(int((p < 0.05).sum()), p.size, 0.05).pvalue > 0.01
        assert np.mean(p) == pytest.approx(0.5, abs=0.05)


def test_a_curve_that_the_model_misses_is_found_and_the_other_is_not() -> None:
    missed = np.where(np.arange(TOTAL) < COUNTS["lv_volume"], 0.0, 15.0 * np.cos(np.arange(TOTAL) / 2.0))
    left, right = fits_of(missed, slopes_of(1.0, 2))
    assert left.p > 0.5
    assert right.p < 1e-3


def test_without_all_slopes_there_is_no_chi_squared() -> None:
    slopes = slopes_of(1.0)
    slopes[:, 2] = np.nan
    values, known = np.zeros(TOTAL), (0.0, 0.0, 0.0, TOTAL, 1, True)
    data = target(values, np.ones(TOTAL, bool), noise())
    fit = Refit(("a",), values, noise(), {}, *known, values, slopes, slopes)
    assert not list(curve_fits(fit, data, data, values))

"""Ranges end where a parabola meets a limit, at the cap, or halfway to a beat that failed."""

from math import exp, inf, log, sqrt

import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.plausible import Limit, Plausible, plausible_ranges
from heartfit.calibration.sensitivity import one_at_a_time_scaling
from heartfit.calibration.unscented import Outcome, sigma_points
from heartfit.core.errors import InputError

PRIOR = Gaussian.from_relative({"sigma_0": 300e3, "K": 1e6}, {"sigma_0": 0.2, "K": 0.25})
POINTS = sigma_points(PRIOR, one_at_a_time_scaling(2, 1.0))
EF, PEAK = Limit("EF", 0.5, 0.7), Limit("P_max", 10e3, inf)


def beat(z: tuple[float, float]) -> dict[str, float]:
    """EF is a parabola in ln sigma_0, P_max linear in it; K does nothing."""
    t = z[0] - PRIOR.mean[0]
    return {"EF": 0.6 + 0.4 * t - 0.2 * t**2, "P_max": 15e3 + 10e3 * t}


def ranges_within(*limits: Limit, lost: int | None = None, cap: float = 2.0) -> Plausible:
    outcomes: list[Outcome] = [beat(point.z) for point in POINTS]
    if lost is not None:
        outcomes[lost] = "inverted"
    return plausible_ranges(POINTS, outcomes, limits, cap)


def test_the_first_limit_on_each_side_ends_the_range() -> None:
    sigma_0 = ranges_within(EF, PEAK).ranges[0]
    above = 1.0 - sqrt(1.0 - 0.5)  # 0.6 + 0.4 t - 0.2 t^2 = 0.7
    below = sqrt(1.5) - 1.0  # = 0.5, before P_max is met at t = -0.5
    assert (sigma_0.highest.stopped_by, sigma_0.lowest.stopped_by) == ("EF", "EF")
    assert log(sigma_0.highest.factor) == pytest.approx(above)
    assert log(sigma_0.lowest.factor) == pytest.approx(-below)
    assert sigma_0.sd == pytest.approx((above + below) / 4)
    assert sigma_0.median == pytest.approx(300e3 * exp((above - below) / 2))


def test_a_straight_line_has_one_root() -> None:
    lowest = ranges_within(PEAK).ranges[0].lowest
    assert (log(lowest.factor), lowest.stopped_by) == (pytest.approx(-0.5), "P_max")


def test_unlimited_ranges_end_at_the_cap() -> None:
    k = ranges_within(EF, PEAK).ranges[1]
    assert (k.lowest.factor, k.highest.factor) == pytest.approx((0.5, 2.0))
    assert k.lowest.stopped_by == k.highest.stopped_by == "cap"
    assert k.median == pytest.approx(1e6)


def test_a_limit_broken_by_the_standard_beat_is_named_and_ignored() -> None:
    result = ranges_within(Limit("EF", 0.61, 0.7))
    assert result.broken == ("EF",)
    assert {end.stopped_by for bounds in result.ranges for end in (bounds.lowest, bounds.highest)} == {"cap"}


def test_a_failed_beat_ends_the_range_halfway_and_the_other_side_is_a_line() -> None:
    sigma_0 = ranges_within(PEAK, lost=1).ranges[0]
    assert (log(sigma_0.highest.factor), sigma_0.highest.stopped_by) == (pytest.approx(0.1), "no beat")
    assert log(sigma_0.lowest.factor) == pytest.approx(-0.5)


def test_without_the_standard_beat_no_range_is_known() -> None:
    with pytest.raises(InputError, match=r"\bmean\b.*fail"):
        ranges_within(EF, lost=0)


def test_deviations_are_in_the_order_of_the_parameters() -> None:
    assert ranges_within().sd == pytest.approx([log(2.0) / 2, log(2.0) / 2])

"""On a linear map intervals cover the truth at their nominal rate if the noise includes all unknowns."""

import numpy as np
import pytest

from heartfit.synthetic.race import Coverage, fixed_noise, sphere_coverage
from heartfit.synthetic.volunteer import OTHER_SPREAD
from tests.synthetic.linear import SLOPES, linear_hearts

HEARTS = 150


@pytest.fixture(scope="module")
def pooled():
    coverages = sphere_coverage(linear_hearts(noise=0.003, unseen=1.5), HEARTS)
    return {(coverage.world, coverage.noise): coverage.pooled() for coverage in coverages}


def test_the_noise_suffices_where_nothing_else_is_unknown(pooled) -> None:
    share = pooled["nothing", "R of the measurement"]
    assert share.low < 0.95 < share.high


def test_scatter_of_fixed_parameters_must_enter_the_noise(pooled) -> None:
    without, stated = (pooled["parameters", way] for way in ("R of the measurement", "R and R_fixed"))
    assert without.high < 0.9
    assert stated.low < 0.95 < stated.high


def test_a_second_step_on_a_linear_map_changes_no_estimate(pooled) -> None:
    one, two = (pooled["parameters", f"R and R_fixed{steps}"] for steps in ("", ", 2 steps"))
    assert two.covered == pytest.approx(one.covered, abs=0.01)


def test_without_noise_the_intervals_are_too_short(pooled) -> None:
    assert pooled["parameters", "R = 0"].high < 0.9


def test_the_noise_of_what_is_fixed_is_that_of_its_slopes() -> None:
    slopes = OTHER_SPREAD * SLOPES[4:]
    assert fixed_noise(linear_hearts()) == pytest.approx(slopes.T @ slopes)


def test_a_failed_calibration_is_not_covered() -> None:
    coverage = Coverage("nothing", "R = 0", ("a", "b"), np.array([[0.0, 3.0], [np.nan, np.nan]]))
    assert [share.covered for share in coverage.shares().values()] == [0.5, 0.0]
    assert (coverage.pooled().covered, coverage.pooled().sequences) == (0.25, 2)

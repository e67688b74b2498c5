"""A check is met within its tolerance, and never by NaN."""

import pytest

from verification.check import AtLeast, Check


@pytest.mark.parametrize(
    ("measured", "passed"), [(2.0, True), (2.1, True), (1.8, False), (2.2, False), (float("nan"), False)]
)
def test_a_check_passes_within_its_tolerance(measured, passed):
    assert Check("order", measured, 2.0, 0.15, "1", "theory").passed is passed


@pytest.mark.parametrize(
    ("measured", "passed"), [(1.9, True), (7.0, True), (1.7, False), (float("nan"), False)]
)
def test_at_least_is_a_bound_on_one_side(measured, passed):
    assert AtLeast("order", measured, 1.8, 0.0, "1", "theory").passed is passed

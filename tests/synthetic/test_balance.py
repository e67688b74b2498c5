"""The value of a parameter at which both sides of a heart pump the same volume."""

import pytest

from heartfit.synthetic.balance import MOST_RATIOS, balancing_value
from heartfit.synthetic.campaign import Inadmissible

RATIO, TOLERANCE = 1.5, 1e-3


@pytest.mark.parametrize("root", [2.0, 1.0, 0.9, 0.25])
def test_the_root_is_found_above_and_below_the_start(root: float) -> None:
    value = balancing_value(lambda x: x**3 - root**3, 1.0, RATIO, TOLERANCE)
    assert value == pytest.approx(root, abs=TOLERANCE)


def test_a_heart_out_of_reach_is_inadmissible() -> None:
    reach = RATIO**MOST_RATIOS
    assert balancing_value(lambda x: x - 0.99 * reach, 1.0, RATIO, TOLERANCE) < reach
    with pytest.raises(Inadmissible, match="do not balance"):
        balancing_value(lambda x: x - 1.01 * reach, 1.0, RATIO, TOLERANCE)


def test_no_value_is_simulated_twice() -> None:
    tried: list[float] = []

    def excess(value: float) -> float:
        tried.append(value)
        return value - 2.0

    balancing_value(excess, 1.0, RATIO, TOLERANCE)
    assert len(tried) == len(set(tried)) > 2

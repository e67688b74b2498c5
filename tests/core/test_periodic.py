"""The bump of prescribed waves."""

import numpy as np
import pytest

from heartfit.core.periodic import bump

PERIOD = 0.8


@pytest.mark.parametrize("centre", [0.02, 0.4, 0.79])
def test_a_bump_is_one_at_its_centre_and_zero_beyond_its_feet(centre: float) -> None:
    """The bump continues across the end of the period; its mean over the width is a half."""
    time = np.linspace(0.0, PERIOD, 8001)
    curve = bump(time, centre, 0.2, PERIOD)
    assert bump(np.array([centre, centre + PERIOD]), centre, 0.2, PERIOD) == pytest.approx([1.0, 1.0])
    assert bump(np.array(centre + 0.05), centre, 0.2, PERIOD) == pytest.approx(0.5)
    assert np.trapezoid(curve, time) == pytest.approx(0.1, rel=1e-6)
    assert not bump(np.array([centre - 0.101, centre + 0.101, centre + 0.4]), centre, 0.2, PERIOD).any()

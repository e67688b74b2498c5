"""What a beat lacks to be periodic, from its start and its end."""

import numpy as np
import pytest

from heartfit.circulation.windkessel import Windkessel, WindkesselState
from heartfit.limit_cycle import SHIFT, Recurrence

VOLUMES = 1e-6 * np.array([[100.0, 80.0], [50.0, 40.0], [101.0, 80.1]])


def recurrence(first: tuple[float, float], last: tuple[float, float]) -> Recurrence:
    return Recurrence(VOLUMES, [WindkesselState(p) for p in first], [WindkesselState(p) for p in last])


def test_the_drift_is_the_largest_of_volumes_over_stroke_and_pressures_over_themselves() -> None:
    assert recurrence((10e3, 2e3), (10e3, 2e3)).drift() == pytest.approx(1.0 / 51.0)
    assert recurrence((10e3, 2e3), (10.1e3, 1.9e3)).drift() == pytest.approx(0.05)


def test_each_windkessel_is_raised_by_the_same_part_of_what_it_lacks() -> None:
    trees = Windkessel(tau=1.6), Windkessel(tau=0.5)
    shifts = recurrence((10e3, 2e3), (10.1e3, 1.9e3)).shifts(trees, 0.8)
    assert shifts == pytest.approx([SHIFT * 100.0 / np.expm1(0.5), -SHIFT * 100.0 / np.expm1(1.6)])

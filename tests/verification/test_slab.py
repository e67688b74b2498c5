"""Slab: the closed form, and what the file of the published code shows."""

import numpy as np
import pytest

from verification.slab import CHASTE_CORNER, SIZE, SPEED, exact, slab

GRID = (7, 15, 41)
SPACING = 0.5e-3


def test_the_closed_form_at_the_corner():
    along, across = 18.5e-3 / 0.65, np.hypot(5.5e-3, 1.5e-3) / 0.28
    assert exact(SIZE[None])[0] == pytest.approx(np.hypot(along, across))


def test_the_wave_never_outruns_the_closed_form_and_is_exact_along_the_fibres():
    points, times = slab(0.5e-3)
    assert (times >= exact(points) - 1e-9).all()
    edge = (points[:, 1:] == 0.0).all(axis=1) & (points[:, 0] > 1.5e-3)
    assert times[edge] == pytest.approx((points[edge, 0] - 1.5e-3) / SPEED)


def test_the_published_file_has_the_stated_speeds(published_slab):
    times = 1e-3 * np.loadtxt(published_slab).reshape(GRID)
    assert times[-1, -1, -1] == pytest.approx(CHASTE_CORNER, abs=5e-6)
    assert times[0, 0, 0] == pytest.approx(1.2e-3, abs=0.05e-3)
    assert 20 * SPACING / (times[0, 0, 30] - times[0, 0, 10]) == pytest.approx(0.50, abs=0.01)
    assert 8 * SPACING / (times[0, 12, 0] - times[0, 4, 0]) == pytest.approx(0.20, abs=0.005)
    assert exact(SIZE[None])[0] == pytest.approx(CHASTE_CORNER, rel=0.1)

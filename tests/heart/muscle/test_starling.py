"""Length dependence: none at slope 0, the published table at slope 1."""

import numpy as np
import pytest

from heartfit.heart.muscle.control import TABLE_EXTENSIONS, TABLE_FRACTIONS, Starling


def green_lagrange(extension: np.ndarray) -> np.ndarray:
    return 0.5 * ((1.0 + extension) ** 2 - 1.0)


def test_without_slope_all_bridges_are_available_at_any_length() -> None:
    assert (Starling(slope=0.0).available_fraction(np.linspace(-0.6, 2.0, 50)) == 1.0).all()


@pytest.mark.parametrize("shift", [0.0, 0.2])
def test_full_slope_is_the_table_of_the_shifted_extension(shift: float) -> None:
    law = Starling(slope=1.0, shift=shift)
    assert law.available_fraction(green_lagrange(TABLE_EXTENSIONS - shift)) == pytest.approx(
        TABLE_FRACTIONS, abs=1e-12
    )
    beyond = green_lagrange(np.array([TABLE_EXTENSIONS[0] - 0.1, TABLE_EXTENSIONS[-1] + 0.1]) - shift)
    assert law.available_fraction(beyond) == pytest.approx(0.0)


def test_half_the_slope_halves_the_missing_bridges_of_the_table() -> None:
    e_c = green_lagrange(np.linspace(-0.3, 0.9, 40))
    half, full = (1.0 - Starling(slope=s).available_fraction(e_c) for s in (0.5, 1.0))
    assert half == pytest.approx(0.5 * full)
    assert full.max() > 0.3


@pytest.mark.parametrize("slope", [1.0, 1.15, 3.0])
def test_a_length_dependence_leaves_no_fewer_bridges_than_none(slope: float) -> None:
    e_c = green_lagrange(np.linspace(-0.6, 2.0, 200))
    n_0, table = (Starling(slope=s).available_fraction(e_c) for s in (slope, 1.0))
    assert n_0 == pytest.approx(np.maximum(1.0 - slope * (1.0 - table), 0.0))
    assert n_0.min() == 0.0

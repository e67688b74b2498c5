"""The rule selects strong and independent rows, as pivoted QR does; both measures have their closed forms."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some
from scipy.linalg import qr

from heartfit.calibration.selection import (
    decomposition,
    rank_among_all,
    select,
    squared_share,
    volume_share,
)

seeds = some.integers(0, 1000)


def random_rows(seed: int, shape: tuple[int, int] = (8, 3)) -> np.ndarray:
    return np.random.default_rng(seed).standard_normal(shape)


@given(seed=seeds)
def test_the_decomposition_is_one_and_its_signs_are_fixed(seed: int) -> None:
    rows = random_rows(seed)
    left, values, right = decomposition(rows)
    assert left * values @ right.T == pytest.approx(rows)
    assert left.T @ left == pytest.approx(np.eye(3), abs=1e-12)
    assert left[np.abs(left).argmax(axis=0), range(3)].min() > 0


@given(seed=seeds)
def test_the_first_rows_are_those_of_pivoted_qr(seed: int) -> None:
    rows = random_rows(seed)
    assert select(rows, 3) == qr(rows.T, pivoting=True)[2][:3].tolist()


def test_the_longer_of_two_parallel_rows_is_selected_and_the_other_comes_last() -> None:
    rows = np.array([[0.0, 3.0], [2.9, 0.0], [0.0, -2.0], [0.1, 0.1]])
    assert select(rows, 4) == [0, 1, 2, 3]


def test_once_every_direction_is_spent_the_strongest_left_is_taken() -> None:
    rows = np.array([[3.0], [1.0], [2.0]])
    assert select(rows, 3) == [0, 2, 1]


@given(seed=seeds)
def test_every_parameter_is_selected_once(seed: int) -> None:
    assert sorted(select(random_rows(seed), 8)) == list(range(8))


@pytest.mark.parametrize("count", [0, 9])
def test_an_invalid_count_is_refused(count: int) -> None:
    with pytest.raises(ValueError, match=r"\b8 parameters.*\b1 to 8"):
        select(random_rows(0), count)


def test_shares_of_all_are_one_and_of_a_plane_have_no_volume() -> None:
    rows = random_rows(1)
    assert squared_share(rows, range(8)) == pytest.approx(1.0)
    assert volume_share(rows, range(8)) == pytest.approx(1.0)
    assert volume_share(np.vstack([rows, rows[0] + rows[1]]), [0, 1, 8]) == pytest.approx(0.0, abs=1e-12)
    assert squared_share(np.diag([1.0, 2.0]), [1]) == pytest.approx(0.8)


@given(seed=seeds)
def test_the_volume_does_not_depend_on_units(seed: int) -> None:
    rows = random_rows(seed)
    assert volume_share(rows * [1.0, 1e3, -0.5], [0, 2, 4, 6]) == pytest.approx(
        volume_share(rows, [0, 2, 4, 6])
    )


def test_the_place_among_all_sets_is_counted() -> None:
    rows = np.diag([1.0, 2.0, 3.0])
    assert rank_among_all(rows, [1, 2], squared_share) == (1, 3)
    assert rank_among_all(rows, [0, 1], squared_share) == (3, 3)

"""Fronts: every node occurs once, and every entry of the fill has its row."""

from collections.abc import Callable

import numpy as np
import pytest

from heartfit.heart.finite_elements import elimination
from heartfit.heart.finite_elements.elimination import Fronts, find_fronts


def filled(tets: np.ndarray, order: np.ndarray) -> list[set[int]]:
    """Later positions that the elimination of each touches, by the definition."""
    position = np.argsort(order)
    touched: list[set[int]] = [set() for _ in order]
    for tet in position[tets]:
        for i in tet:
            touched[i] |= {int(j) for j in tet if j > i}
    for i in range(len(order)):
        for j in touched[i]:
            touched[j] |= {k for k in touched[i] if k > j}
    return touched


@pytest.fixture(params=[(0, 0.0, 1), (8, 0.05, 32), (100, 1.0, 100)], ids=["single", "default", "one"])
def dissected(request, monkeypatch, block: Callable) -> tuple[np.ndarray, Fronts]:
    for name, value in zip(("MERGE_SIZE", "MERGE_WASTE", "LARGEST_FRONT"), request.param, strict=True):
        monkeypatch.setattr(elimination, name, value)
    mesh = block((4, 3, 3))
    return mesh.tets, find_fronts(mesh.tets, len(mesh.points))


def test_every_node_is_eliminated_once(dissected: tuple[np.ndarray, Fronts]) -> None:
    _, fronts = dissected
    assert sorted(fronts.order) == list(range(len(fronts.order)))
    assert fronts.starts[0] == 0
    assert fronts.starts[-1] == len(fronts.order)
    assert (np.diff(fronts.starts) > 0).all()


def test_a_front_has_the_rows_of_its_nodes(dissected: tuple[np.ndarray, Fronts]) -> None:
    tets, fronts = dissected
    touched = filled(tets, fronts.order)
    for s in range(len(fronts.parents)):
        start, end = fronts.starts[s], fronts.starts[s + 1]
        rows = fronts.rows[fronts.row_starts[s] : fronts.row_starts[s + 1]]
        needed = set.union(*touched[start:end])
        assert list(rows) == sorted(j for j in needed if j >= end)


def test_the_parent_eliminates_the_first_row(dissected: tuple[np.ndarray, Fronts]) -> None:
    _, fronts = dissected
    for s, parent in enumerate(fronts.parents):
        rows = fronts.rows[fronts.row_starts[s] : fronts.row_starts[s + 1]]
        if parent == -1:
            assert len(rows) == 0
        else:
            assert fronts.starts[parent] <= rows[0] < fronts.starts[parent + 1]


def test_fronts_of_single_nodes_have_the_minimal_fill(dissected: tuple[np.ndarray, Fronts]) -> None:
    """Merging may add rows, never lose one; without it, the fill is that of the definition."""
    tets, fronts = dissected
    entries = np.diff(fronts.row_starts).sum()
    least = sum(map(len, filled(tets, fronts.order)))
    alone = (np.diff(fronts.starts) == 1).all()
    assert entries == least if alone else entries < least

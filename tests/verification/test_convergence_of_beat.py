"""The table of convergence: differences of given rows, and the rows of a small block."""

import numpy as np
import pytest

from heartfit.geometry.cube import cube
from heartfit.heart.heart import Heart
from tests.printed import numbers_in, outside_tables
from verification.convergence_of_beat import (
    OBSERVATIONS,
    Row,
    Size,
    coarsest_within,
    convergence_page,
    rows_of,
)


def row(tetrahedra, error, time_step=5e-3):
    observed = {name: (1.0 + error) * (-1.0 if name.endswith("min") else 1.0) for name in OBSERVATIONS}
    return Row(Size(tetrahedra, 1.6e-4, 1.9e-4), "backward Euler", time_step, observed, 1.0)


def test_the_coarsest_mesh_within_two_percent_is_named():
    rows = [row(3000, 0.05), row(10000, -0.015), row(20000, 0.001), row(30000, 0.0)]
    assert coarsest_within(rows, 0.02).size.tetrahedra == 10000
    assert coarsest_within([rows[0], rows[-1]], 0.02) is None
    assert rows[0].beside(rows[-1])["q_min"] == pytest.approx(0.05), "negative numbers count equally"


def test_the_page_compares_meshes_at_the_usual_step_and_steps_on_the_same_mesh():
    page = convergence_page(
        [row(3000, 0.05), row(3000, 0.03, 2.5e-3), row(9000, 0.0), row(9000, 0.0, 2.5e-3)]
    )
    assert "| 3000 | 160.0 | 190.0 | -1.05e+06 (+5.0 %) | 1.05e+06" in page
    assert "| 3000 | backward Euler | 5 | +1.94 % |" in page
    assert 3000.0 not in numbers_in(outside_tables(page)), "5 % is too far"
    near = convergence_page([row(3000, 0.01), row(9000, 0.0)])
    assert 3000.0 in numbers_in(outside_tables(near))


def test_every_mesh_is_observed_at_every_step():
    blocks = [cube(n, 0.02) for n in (1, 2)]
    rows = list(rows_of(Heart(), blocks, np.array([100.0, 100.0]), (20e-3, 10e-3)))
    assert [row.time_step for row in rows if row.scheme == rows[-1].scheme] == 2 * [20e-3, 10e-3]
    assert [row.size.tetrahedra for row in rows][:: len(rows) // 2] == [len(block.tets) for block in blocks]
    assert all(np.isfinite(list(row.observed.values())).all() for row in rows)

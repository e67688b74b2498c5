"""The table of convergence: differences of given rows, and the rows of a small block."""

import numpy as np

from heartfit.geometry.cube import cube
from heartfit.heart.heart import Heart
from verification.convergence_of_beat import (
    OBSERVATIONS,
    Row,
    Size,
    mesh_table,
    rows_of,
    step_table,
)


def row(tetrahedra, error, time_step=5e-3):
    observed = {name: (1.0 + error) * (-1.0 if name.endswith("min") else 1.0) for name in OBSERVATIONS}
    return Row(Size(tetrahedra, 1.6e-4, 1.9e-4), "backward Euler", time_step, observed, 1.0)


def test_meshes_are_compared_at_the_usual_step_and_steps_on_the_same_mesh():
    rows = [row(3000, 0.05), row(3000, 0.03, 2.5e-3), row(9000, 0.0), row(9000, 0.0, 2.5e-3)]
    meshes, steps = mesh_table(rows), step_table(rows)
    assert meshes["tetrahedra"].tolist() == ["3000", "9000"]
    assert meshes["q_min, mL/s"][0] == "-1.05e+06 (+5.0 %)", "negative numbers count equally"
    assert steps[["tetrahedra", "step, ms", "V_min"]].to_numpy().tolist()[0] == ["3000", "5", "+1.94 %"]
    assert set(steps["V_min"][[1, 3]]) == {"+0.00 %"}


def test_every_mesh_is_observed_at_every_step():
    blocks = [cube(n, 0.02) for n in (1, 2)]
    rows = list(rows_of(Heart(), blocks, np.array([100.0, 100.0]), (20e-3, 10e-3)))
    assert [row.time_step for row in rows if row.scheme == rows[-1].scheme] == 2 * [20e-3, 10e-3]
    assert [row.size.tetrahedra for row in rows][:: len(rows) // 2] == [len(block.tets) for block in blocks]
    assert all(np.isfinite(list(row.observed.values())).all() for row in rows)

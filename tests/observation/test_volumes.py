"""Volume curves of cavities whose volume is known: cubes without lid that swell and shrink."""

import numpy as np
import pytest

from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.observation.shape import cavity_volumes

CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
SQUARES = [
    (0, 1, 3, 2),
    (4, 6, 7, 5),
    (0, 4, 5, 1),
    (2, 3, 7, 6),
    (0, 2, 6, 4),
]  # seen from outside; open above
INWARD = np.array([triangle for a, b, c, d in SQUARES for triangle in ((a, c, b), (a, d, c))])


def test_open_cubes_have_their_volume_in_every_phase() -> None:
    sizes = 0.04 + 0.01 * np.cos(2 * np.pi * np.arange(10) / 10)
    cubes = np.vstack([CORNERS, 1.1 * CORNERS + 3.0])
    mesh = VentricularMesh(
        points=cubes,
        tets=np.array([[0, 4, 2, 1]]),
        surfaces={"lv_endo": INWARD, "rv_endo": INWARD + 8, "epi": INWARD, "base": INWARD},
    )
    motion = Motion(np.arange(10) * 0.08, 0.8, sizes[:, None, None] * cubes)
    curves = cavity_volumes(mesh, motion)
    assert curves["lv_volume"].values == pytest.approx(sizes**3, rel=1e-12)
    assert curves["rv_volume"].values == pytest.approx((1.1 * sizes) ** 3, rel=1e-9)
    assert curves["lv_volume"].period == 0.8

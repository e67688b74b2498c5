"""Harmonic fields: linear values on the boundary give a linear field inside."""

import numpy as np
import pytest
from skfem import MeshTet

from heartfit.geometry.harmonic import element_gradients, harmonic_extension

BLOCK = MeshTet().refined(2)
POINTS, TETS = BLOCK.p.T, BLOCK.t.T.astype(np.int64)


def test_linear_fields_are_reproduced_and_differentiated_exactly() -> None:
    slopes = np.random.default_rng(1).standard_normal((3, 2))
    boundary = BLOCK.boundary_nodes()
    field = harmonic_extension(POINTS, TETS, boundary, (POINTS @ slopes)[boundary])
    assert field == pytest.approx(POINTS @ slopes, abs=1e-12)
    for component in range(2):
        gradient = element_gradients(POINTS, TETS, field[:, component])
        assert gradient == pytest.approx(np.tile(slopes[:, component], (len(TETS), 1)), abs=1e-10)


def test_a_field_that_is_free_at_the_sides_runs_straight_from_plane_to_plane() -> None:
    ends = np.flatnonzero((POINTS[:, 2] == 0.0) | (POINTS[:, 2] == 1.0))
    field = harmonic_extension(POINTS, TETS, ends, POINTS[ends, 2])
    assert field == pytest.approx(POINTS[:, 2], abs=1e-12)

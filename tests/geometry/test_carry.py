"""Carrying of meshes: motions with known results, and a mesh carried by itself."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.geometry.carry import boundary_surface, carry_mesh, count_inverted_elements
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.surface import LabelledSurface

PHASES = 9
TIMES = np.linspace(0.0, 0.8, PHASES)
PERIOD = 0.9


def stretched(points: np.ndarray) -> np.ndarray:
    """Phases (p,n,3) of a motion that shears, shortens and shifts the points more and more."""
    gradient = np.array([[-0.1, 0.05, 0.0], [0.02, -0.12, 0.03], [0.0, 0.0, -0.15]])
    share = np.linspace(0.0, 1.0, PHASES)[:, None, None]
    return points + share * (points @ gradient.T + [0.01, -0.02, 0.005])


@pytest.fixture(scope="module")
def surface(ventricle: VentricularMesh) -> LabelledSurface:
    return boundary_surface(ventricle, ventricle.points)


def test_the_boundary_surface_encloses_the_wall_under_the_same_names(
    ventricle: VentricularMesh, surface: LabelledSurface
) -> None:
    assert surface.volume() == pytest.approx(ventricle.wall_volume(), rel=1e-12)
    for name, faces in ventricle.surfaces.items():
        here = surface.points[surface.surfaces[name]].mean(axis=(0, 1))
        assert here == pytest.approx(ventricle.points[faces].mean(axis=(0, 1)))


def test_an_affine_motion_of_the_surface_carries_every_node_exactly(
    ventricle: VentricularMesh, surface: LabelledSurface
) -> None:
    motion = carry_mesh(ventricle, surface, stretched(surface.points), TIMES, PERIOD)
    assert motion.positions == pytest.approx(stretched(ventricle.points), abs=1e-10)
    assert count_inverted_elements(ventricle, motion).tolist() == [0] * PHASES
    assert motion.period == PERIOD


def test_nodes_off_the_surface_keep_their_distance(
    ventricle: VentricularMesh, surface: LabelledSurface
) -> None:
    off = ventricle.with_points(ventricle.points + np.array([2e-4, 1e-4, -2e-4]))
    motion = carry_mesh(off, surface, stretched(surface.points), TIMES, PERIOD)
    assert motion.positions[0] == pytest.approx(off.points, abs=1e-15)
    cavity = Cavity.from_endocardium(ventricle, "lv_endo")
    assert cavity.volume(motion.positions[-1]) == pytest.approx(
        cavity.volume(stretched(ventricle.points)[-1]), rel=5e-3
    )


def test_an_inverted_element_is_counted(ventricle: VentricularMesh, surface: LabelledSurface) -> None:
    motion = carry_mesh(ventricle, surface, stretched(surface.points), TIMES, PERIOD)
    mirrored = motion.positions.copy()
    mirrored[3] *= [1.0, 1.0, -1.0]
    counts = count_inverted_elements(ventricle, replace(motion, positions=mirrored))
    assert counts[3] == len(ventricle.tets)
    assert counts.sum() == counts[3]

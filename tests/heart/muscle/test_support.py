"""The support of the heart: springs and dampers at the rings, a sliding pericardium, stiff annuli."""

from collections.abc import Callable

import numpy as np
import pytest

from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.muscle.tissue import Support

EDGE = 0.04


@pytest.fixture
def mesh(block: Callable) -> VentricularMesh:
    return block()


def test_springs_and_dampers_are_symmetric_and_take_no_energy(mesh: VentricularMesh) -> None:
    for matrices in (Support().stiffness(mesh), Support().damping(mesh)):
        assert pytest.approx(matrices.swapaxes(1, 2)) == matrices
        assert (np.linalg.eigvalsh(matrices) >= -1e-12 * abs(matrices).max()).all()


def test_rings_are_supported_equally_in_every_direction(mesh: VentricularMesh) -> None:
    support = Support(k_b=3e4, c_b=2e3, k_p=0.0)
    assert support.stiffness(mesh).sum(axis=0) == pytest.approx(3e4 * EDGE**2 * np.eye(3))
    assert support.damping(mesh).sum(axis=0) == pytest.approx(2e3 * EDGE**2 * np.eye(3))


def test_the_pericardium_slides(mesh: VentricularMesh) -> None:
    """Within the flat side y = 0 only the normal displacement meets a spring."""
    springs = Support(k_b=0.0).stiffness(mesh)
    x, y, z = mesh.points.T
    within = (y < 1e-9) & (x > 1e-9) & (x < EDGE - 1e-9) & (z > 1e-9) & (z < EDGE - 1e-9)
    assert within.sum() == 4
    normal = np.outer([0.0, 1.0, 0.0], [0.0, 1.0, 0.0])
    assert springs[within] == pytest.approx(springs[within][:, 1, 1, None, None] * normal, abs=1e-12)
    assert (springs[within][:, 1, 1] > 0.0).all()


def test_the_pericardium_is_as_stiff_as_stated(mesh: VentricularMesh) -> None:
    """Both sides of y and the apical one of x are epicardium."""
    even = Support(k_b=0.0, k_p=2e5, apical=1.0).stiffness(mesh).sum(axis=0)
    assert even == pytest.approx(2e5 * EDGE**2 * np.diag([1.0, 2.0, 0.0]), abs=1e-9)
    apical = Support(k_b=0.0, k_p=2e5, apical=7.0).stiffness(mesh).sum(axis=0)
    assert apical[0, 0] == pytest.approx(7.0 * even[0, 0])
    assert even[1, 1] < apical[1, 1] < 7.0 * even[1, 1]


def test_annuli_stiffen_the_wall_next_to_the_rings_only(mesh: VentricularMesh) -> None:
    support = Support(annulus=20.0, annulus_core=0.012, annulus_width=0.02)
    scale = support.passive_scale(mesh)
    assert scale.min() == 1.0
    assert scale.max() == pytest.approx(20.0)
    depth = mesh.points[mesh.tets].mean(axis=1)[:, 0]
    assert (scale[depth > 0.02] == 1.0).all()
    assert (scale[depth < 0.002] > 1.0).all()

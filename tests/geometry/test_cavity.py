"""The cavity's volume against a box and its derivative against differences that shrink."""

from types import SimpleNamespace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh

CORNERS = np.array([[x, y, z] for z in (0.0, 3.0) for y in (0.0, 2.0) for x in (0.0, 1.0)])
# The floor and the four walls of a box without a lid, normals into the box.
FACES = [[0, 1, 3, 2], [0, 4, 5, 1], [1, 5, 7, 3], [3, 7, 6, 2], [2, 6, 4, 0]]
BOX = np.array([triangle for a, b, c, d in FACES for triangle in ([a, b, c], [a, c, d])])


@pytest.fixture
def box() -> Cavity:
    return Cavity.from_endocardium(SimpleNamespace(surfaces={"lv_endo": BOX}), "lv_endo")


def test_an_open_box_holds_the_product_of_its_edges_at_every_place(box: Cavity) -> None:
    assert box.volume(CORNERS) == pytest.approx(6.0)
    assert box.volume(CORNERS + np.array([7.0, -4.0, 2.0])) == pytest.approx(6.0)


def test_the_lids_pressure_is_spread_over_the_rim(box: Cavity) -> None:
    gradient = box.gradient(CORNERS)
    assert gradient.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-14)
    assert gradient[4:, 2].sum() == pytest.approx(2.0)  # area of the lid
    assert (gradient[4:, 2] > 0.0).all()


@pytest.mark.parametrize("seed", range(4))
def test_the_gradient_is_the_limit_of_differences(box: Cavity, seed: int) -> None:
    rng = np.random.default_rng(seed)
    x, direction = CORNERS + 0.3 * rng.standard_normal((8, 3)), rng.standard_normal((8, 3))
    slope = float((box.gradient(x) * direction).sum())
    steps = np.array([0.1, 0.05, 0.025])
    error = [
        abs((box.volume(x + h * direction) - box.volume(x - h * direction)) / (2 * h) - slope) for h in steps
    ]
    assert np.log2(np.array(error[:-1]) / error[1:]) == pytest.approx([2.0, 2.0], abs=1e-3)


def test_volume_is_homogeneous_of_degree_three(ventricle: VentricularMesh) -> None:
    for name in ("lv_endo", "rv_endo"):
        cavity = Cavity.from_endocardium(ventricle, name)
        power = float((cavity.gradient(ventricle.points) * ventricle.points).sum())
        assert power == pytest.approx(3.0 * cavity.volume(ventricle.points), rel=1e-12)


def test_a_closed_endocardium_is_refused() -> None:
    closed = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    with pytest.raises(InputError, match="opening"):
        Cavity.from_endocardium(SimpleNamespace(surfaces={"lv_endo": closed}), "lv_endo")


def test_the_surface_with_its_lids_is_closed_and_holds_the_cavity(ventricle: VentricularMesh) -> None:
    """Its normals point inwards, hence the sign; a lid's apex is the mean of its ring."""
    cavity = Cavity.from_endocardium(ventricle, "lv_endo")
    corners = cavity.corners(ventricle.points)
    triangles = cavity.triangles % len(corners)
    a, b, c = np.moveaxis(corners[triangles], 1, 0)
    assert -(a * np.cross(b, c)).sum() / 6.0 == pytest.approx(cavity.volume(ventricle.points), rel=1e-12)
    assert np.cross(b - a, c - a).sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-15)
    assert len(cavity.lids) == len(cavity.rim)
    np.testing.assert_array_equal(np.unique(cavity.lids[cavity.lids >= 0]), np.unique(cavity.rim))
    ring = cavity.rim[: cavity.rim_start[1]]
    assert corners[-1] == pytest.approx(ventricle.points[ring].mean(axis=0))

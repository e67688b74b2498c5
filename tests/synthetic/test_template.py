"""One mesh for all hearts: it is morphed into other walls, or the wall is remeshed."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh, smallest_dihedral_angles
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.synthetic.volunteer import AVERAGE, Template, draw_anatomy
from tests.synthetic.conftest import built

DILATED = ParametricVentricles(200e-6, 9e-3, 1.7, 170e-6, 3.6e-3)
SHAPES = {"small": draw_anatomy(1010).shape, "dilated": DILATED}


def cavities(mesh: VentricularMesh) -> list[float]:
    return [Cavity.from_endocardium(mesh, name).volume(mesh.points) for name in ("lv_endo", "rv_endo")]


@pytest.fixture(scope="module")
def other() -> Template:
    return built(0.025, 1.8e-3)


def test_the_template_of_the_average_wall_does_not_move(template: Template) -> None:
    assert template.deformed_to(AVERAGE).points == pytest.approx(template.mesh.points, abs=1e-12)


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.filterwarnings("error")
def test_the_moved_mesh_fills_the_wall_of_the_shape(name: str, template: Template) -> None:
    shape = SHAPES[name]
    deformed = template.deformed_to(shape)
    assert deformed.wall_volume() == pytest.approx(shape.surface().volume(), rel=0.02)
    coarseness = np.array(cavities(template.mesh)) / [AVERAGE.edv, AVERAGE.rv_edv]
    assert cavities(deformed) == pytest.approx(coarseness * [shape.edv, shape.rv_edv], rel=0.01)
    assert np.rad2deg(smallest_dihedral_angles(deformed.points, deformed.tets).min()) >= 8.0
    assert np.array_equal(deformed.tets, template.mesh.tets)


def test_a_heart_repeats_to_the_bit(template: Template) -> None:
    first, second = (template.deformed_to(DILATED).points for _ in range(2))
    assert np.array_equal(first, second)


@pytest.mark.filterwarnings("error")
def test_the_other_template_refills_the_same_wall_with_other_nodes(
    template: Template, other: Template
) -> None:
    acquired = template.deformed_to(DILATED)
    bulge = 1.0 + 0.03 * np.sin(40.0 * acquired.points[:, 2:])  # of a beat; shapes have none
    acquired = acquired.with_points(acquired.points * bulge)
    refilled = other.fill_wall_of(acquired, template.mesh)
    assert refilled.wall_volume() == pytest.approx(acquired.wall_volume(), rel=0.02)
    assert cavities(refilled) == pytest.approx(cavities(acquired), rel=0.02)
    assert len(refilled.points) != len(acquired.points)


def test_a_wall_spoilt_by_morphing_is_remeshed(template: Template) -> None:
    points, tets = template.mesh.points.copy(), template.mesh.tets
    top, *foot = tets[smallest_dihedral_angles(points, tets).argmin()]
    points[top] = 0.01 * points[top] + 0.99 * points[foot].mean(axis=0)
    spoilt = replace(template, edge_length=0.025, tolerance=1.8e-3, mesh=template.mesh.with_points(points))
    with pytest.warns(UserWarning, match=r"smallest dihedral angle"):
        mesh = spoilt.deformed_to(DILATED)
    assert np.rad2deg(smallest_dihedral_angles(mesh.points, mesh.tets).min()) >= 8.0


def test_a_wall_of_another_mesh_is_remeshed(template: Template, other: Template) -> None:
    with pytest.warns(UserWarning, match="numbered differently"):
        mesh = other.fill_wall_of(template.deformed_to(DILATED), other.mesh)
    assert mesh.wall_volume() == pytest.approx(DILATED.surface().volume(), rel=0.04)

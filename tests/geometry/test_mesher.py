"""Filling the wall: volume, angles, names and openings of the tetrahedra, and no output or files of the mesher."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.geometry import mesher
from heartfit.geometry.mesh import smallest_dihedral_angles
from heartfit.geometry.mesher import MeshingError, fill_wall
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.geometry.surface import LabelledSurface, boundary_faces, rim_loops, triangle_normals


@pytest.fixture(scope="module")
def surface() -> LabelledSurface:
    return ParametricVentricles(130e-6, 10e-3, 1.8, 140e-6, 4.5e-3).surface()


def test_the_wall_is_filled_with_good_tetrahedra_without_output(
    surface: LabelledSurface,
    capfd: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    mesh = fill_wall(surface, edge_length=0.017, tolerance=0.0012)
    assert mesh.wall_volume() == pytest.approx(surface.volume(), rel=0.02)
    assert mesh.element_volumes().min() > 0.0
    assert np.rad2deg(smallest_dihedral_angles(mesh.points, mesh.tets).min()) >= 8.0
    assert sum(len(faces) for faces in mesh.surfaces.values()) == len(boundary_faces(mesh.tets))
    assert [len(rim_loops(mesh.surfaces[name])) for name in ("lv_endo", "rv_endo")] == [1, 1]
    base = triangle_normals(mesh.points, mesh.surfaces["base"])
    assert np.median(base[:, 2]) > 0.99
    assert capfd.readouterr().out == ""
    assert not list(tmp_path.iterdir())


def test_a_tolerance_wider_than_the_wall_is_refused_with_its_reason(surface: LabelledSurface) -> None:
    with pytest.raises(MeshingError, match=r"tolerance 9 mm: 1 bad meshes: .*(hole|volume|angle|openings)"):
        fill_wall(surface, edge_length=0.05, tolerance=0.009, attempts=1)


def test_a_crash_of_the_mesher_is_reported_and_no_other_seed_is_tried(
    surface: LabelledSurface, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = []

    def crash(*arguments: object) -> None:
        calls.append(arguments)
        raise ChildProcessError("the mesher ended with -6: double free")

    monkeypatch.setattr(mesher, "tetrahedralise", crash)
    with pytest.raises(
        MeshingError, match=r"^edge length 10 mm, tolerance 1 mm: .* double free; use a shorter"
    ):
        fill_wall(surface, edge_length=0.01, tolerance=0.001)
    assert len(calls) == 1


def test_the_angle_of_regular_and_flat_tetrahedra() -> None:
    regular = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    flat = regular * [1.0, 1.0, 1e-3]
    angles = smallest_dihedral_angles(np.vstack([regular, flat]), np.array([[0, 1, 2, 3], [4, 5, 6, 7]]))
    assert np.rad2deg(angles[0]) == pytest.approx(70.5288)
    assert np.rad2deg(angles[1]) < 1.0


def test_a_triangle_surrounded_by_another_label_takes_that_label() -> None:
    pairs = np.array([[0, 1], [0, 2], [0, 3]])
    labels = mesher._remove_islands(np.array(["base", "epi", "epi", "epi"]), pairs)
    assert labels.tolist() == ["epi"] * 4

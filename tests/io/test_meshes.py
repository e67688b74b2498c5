"""Meshes are read back exactly; invalid meshes are refused."""

from dataclasses import replace
from pathlib import Path

import meshio
import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.io.meshes import read_mesh, read_motion, write_mesh, write_motion

FIELDS = ("points", "tets", "fibres", "orientation", "segments", "activation", "longitudinal")


def test_a_mesh_comes_back_bit_for_bit(ventricle: VentricularMesh, tmp_path: Path) -> None:
    write_mesh(tmp_path / "new" / "mesh.vtu", ventricle)
    restored = read_mesh(tmp_path / "new" / "mesh.vtu")
    for name in FIELDS:
        wanted, got = getattr(ventricle, name), getattr(restored, name)
        assert got.dtype == wanted.dtype, name
        assert np.array_equal(got, wanted), name
    for name, faces in ventricle.surfaces.items():
        assert np.array_equal(restored.surfaces[name], faces), name


def test_a_bare_mesh_stays_bare(ventricle: VentricularMesh, tmp_path: Path) -> None:
    write_mesh(tmp_path / "mesh.vtu", replace(ventricle, **dict.fromkeys(FIELDS[2:])))
    restored = read_mesh(tmp_path / "mesh.vtu")
    assert [getattr(restored, name) for name in FIELDS[2:]] == [None] * 5


def test_inverted_tets_are_refused_by_number(ventricle: VentricularMesh, tmp_path: Path) -> None:
    tets = ventricle.tets.copy()
    tets[5] = tets[5, [1, 0, 2, 3]]
    write_mesh(tmp_path / "mesh.vtu", replace(ventricle, tets=tets))
    with pytest.raises(InputError, match="1 tetrahedra are inverted or flat, first tet 5"):
        read_mesh(tmp_path / "mesh.vtu")


def test_missing_and_foreign_files_are_refused(tmp_path: Path) -> None:
    for read in (read_mesh, read_motion):
        with pytest.raises(InputError, match="missing"):
            read(tmp_path / "nothing")
    meshio.Mesh(np.eye(3), [("triangle", [[0, 1, 2]])]).write(tmp_path / "other.vtu")
    with pytest.raises(InputError, match="expected tetrahedra and triangles"):
        read_mesh(tmp_path / "other.vtu")


def test_a_motion_comes_back_bit_for_bit(tmp_path: Path) -> None:
    motion = Motion(np.linspace(0.0, 0.7, 8), 0.8, np.random.default_rng(0).random((8, 5, 3)))
    write_motion(tmp_path / "new" / "motion.npz", motion)
    restored = read_motion(tmp_path / "new" / "motion.npz")
    assert np.array_equal(restored.times, motion.times)
    assert np.array_equal(restored.positions, motion.positions)
    assert restored.period == motion.period


def test_a_file_that_is_no_mesh_is_refused(tmp_path: Path) -> None:
    (tmp_path / "mesh.vtu").write_text("nothing of the kind")
    with pytest.raises(InputError, match="expected a mesh"):
        read_mesh(tmp_path / "mesh.vtu")


def test_a_mesh_that_cannot_be_written_leaves_the_old_one(
    ventricle: VentricularMesh, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stop(self: meshio.Mesh, path: Path) -> None:
        path.write_text("half")
        raise OSError("the disk is full")

    write_mesh(tmp_path / "mesh.vtu", ventricle)
    monkeypatch.setattr(meshio.Mesh, "write", stop)
    with pytest.raises(OSError, match="full"):
        write_mesh(tmp_path / "mesh.vtu", ventricle)
    assert [path.name for path in tmp_path.iterdir()] == ["mesh.vtu"]
    assert len(read_mesh(tmp_path / "mesh.vtu").tets) == len(ventricle.tets)

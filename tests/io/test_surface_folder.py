"""Folders of surface meshes: the same heart from closed and open surfaces; one line for each fault."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import meshio
import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.geometry.surface import SURFACES, LabelledSurface
from heartfit.io.measured_heart import read_measured_heart
from heartfit.io.surface_folder import read_surfaces, surface_files

PHASES = 8
NOTES = {"unit": "mm", "period_s": 0.8}
FILES = {"lv_endo": "LV_ENDOCARDIAL", "rv_endo": "RV_ENDOCARDIAL", "epi": "EPICARDIAL"}


@pytest.fixture(scope="module")
def ventricles() -> LabelledSurface:
    return ParametricVentricles(150e-6, 10e-3, 1.8, 160e-6, 3.5e-3).surface()


def places(surface: LabelledSurface, phase: int) -> np.ndarray:
    """Coordinates in mm of a beat that only changes the size."""
    return 1e3 * surface.points * (1.0 - 0.02 * phase)


def write_notes(folder: Path, **changes: object) -> None:
    notes = {key: value for key, value in {**NOTES, **changes}.items() if value is not None}
    (folder / "surfaces.json").write_text(json.dumps(notes))


def write_closed(folder: Path, surface: LabelledSurface, suffix: str = "vtu") -> None:
    folder.mkdir(exist_ok=True)
    numbers = [np.array([SURFACES.index(label) for label in surface.labels])]
    for phase in range(PHASES):
        mesh = meshio.Mesh(
            places(surface, phase), [("triangle", surface.triangles)], cell_data={"label": numbers}
        )
        mesh.write(folder / f"wall_{phase:02d}.{suffix}")
    write_notes(folder, labels={name: number for number, name in enumerate(SURFACES)})


def write_open(folder: Path, surface: LabelledSurface, suffix: str, files: dict[str, str] = FILES) -> None:
    """Three files a phase, without the base, each with the nodes that it needs."""
    folder.mkdir(exist_ok=True)
    for phase in range(PHASES):
        for name, word in files.items():
            used, triangles = np.unique(surface.surfaces[name], return_inverse=True)
            mesh = meshio.Mesh(places(surface, phase)[used], [("triangle", triangles.reshape(-1, 3))])
            mesh.write(folder / f"mine_{word}_{phase:02d}.{suffix}")
    write_notes(folder)


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory, ventricles: LabelledSurface) -> Path:
    """A folder of closed surfaces that no test changes."""
    folder = tmp_path_factory.mktemp("closed") / "mine"
    write_closed(folder, ventricles)
    return folder


@pytest.fixture
def closed(tmp_path: Path, written: Path) -> Path:
    return shutil.copytree(written, tmp_path / "mine")


def test_a_closed_surface_is_read_as_it_was(closed: Path, ventricles: LabelledSurface) -> None:
    heart = read_surfaces(closed)
    assert heart.period == 0.8
    np.testing.assert_allclose(heart.times, 0.1 * np.arange(8))
    np.testing.assert_allclose(heart.surface.points, ventricles.points, atol=1e-9)
    assert np.array_equal(heart.surface.labels, ventricles.labels)
    assert heart.at(5).volume() == pytest.approx(0.9**3 * ventricles.volume())
    assert len(surface_files(closed)) == PHASES + 1


@pytest.mark.parametrize("suffix", ["ply", "obj", "vtk"])
def test_open_surfaces_are_joined_at_the_base(
    tmp_path: Path, ventricles: LabelledSurface, suffix: str
) -> None:
    write_open(tmp_path, ventricles, suffix)
    heart = read_surfaces(tmp_path)
    assert heart.surface.volume() == pytest.approx(ventricles.volume(), rel=1e-5)
    for name in FILES:
        assert len(heart.surface.surfaces[name]) == len(ventricles.surfaces[name])


@pytest.mark.published
def test_an_epicardium_that_reaches_the_valves_gives_its_rim_to_the_base(
    tmp_path: Path, published_heart_folder: Path
) -> None:
    for file in (published_heart_folder / "vtk_ED_ES").glob("*_000.vtk"):
        for phase in range(PHASES):
            (tmp_path / file.name.replace("000", f"{phase:03d}")).symlink_to(file)
    write_notes(tmp_path)
    surface, fitted = read_surfaces(tmp_path).surface, read_measured_heart(published_heart_folder).surface
    assert surface.volume() == pytest.approx(fitted.volume(), rel=1e-6)
    assert [len(part) for part in surface.surfaces.values()] == [
        len(part) for part in fitted.surfaces.values()
    ]


def file_of(folder: Path, phase: int) -> Path:
    return folder / f"wall_{phase:02d}.vtu"


def rewritten(folder: Path, phase: int, change: Callable[[meshio.Mesh], meshio.Mesh]) -> None:
    change(meshio.read(file_of(folder, phase))).write(file_of(folder, phase))


def with_nan(mesh: meshio.Mesh) -> meshio.Mesh:
    mesh.points[7] = np.nan
    return mesh


def mirrored(mesh: meshio.Mesh) -> meshio.Mesh:
    mesh.points[:, 0] *= -1.0
    return mesh


def renumbered(mesh: meshio.Mesh) -> meshio.Mesh:
    mesh.cells[0].data = np.roll(mesh.cells[0].data, 1, axis=0)
    return mesh


def fewer(mesh: meshio.Mesh) -> meshio.Mesh:
    return meshio.Mesh(mesh.points[:-1], [("triangle", mesh.cells_dict["triangle"][:5])])


def torn(mesh: meshio.Mesh) -> meshio.Mesh:
    label = mesh.cell_data_dict["label"]["triangle"][1:]
    return meshio.Mesh(
        mesh.points, [("triangle", mesh.cells_dict["triangle"][1:])], cell_data={"label": [label]}
    )


FAULTS: dict[str, tuple[Callable[[Path], object], str]] = {
    "no notes": (lambda at: (at / "surfaces.json").unlink(), r"surfaces\.json: no such file"),
    "no unit": (lambda at: write_notes(at, unit=None), "unit is None; expected one of mm"),
    "inches": (lambda at: write_notes(at, unit="in"), "unit is 'in'"),
    "no period": (lambda at: write_notes(at, period_s=None), "length of the beat"),
    "ms for s": (lambda at: write_notes(at, period_s=800), "a beat of 800 s"),
    "a text for a period": (lambda at: write_notes(at, period_s="0.8"), "period_s, a number"),
    "unknown key": (lambda at: write_notes(at, period_ms=800), "unknown key period_ms"),
    "labels of some": (
        lambda at: write_notes(at, labels={"epi": 1}),
        "a number of its own for each of lv_endo",
    ),
    "other labels": (
        lambda at: write_notes(at, labels={name: 7 + n for n, name in enumerate(SURFACES)}),
        r"labels 0, 1, 2, 3 are not stated",
    ),
    "seven phases": (lambda at: file_of(at, 7).unlink(), "7 phases; expected at least 8"),
    "a phase skipped": (lambda at: file_of(at, 7).rename(file_of(at, 9)), "but 7 is missing"),
    "no number": (lambda at: file_of(at, 7).rename(at / "wall.vtu"), "no number in its name"),
    "truncated": (lambda at: file_of(at, 3).write_bytes(file_of(at, 3).read_bytes()[:900]), "wall_03.vtu"),
    "empty": (lambda at: file_of(at, 3).write_bytes(b""), "wall_03.vtu"),
    "nan": (lambda at: rewritten(at, 3, with_nan), "wall_03.vtu: holds NaN"),
    "fewer nodes": (lambda at: rewritten(at, 3, fewer), r"wall_03\.vtu: \d+ nodes, expected"),
    "renumbered": (lambda at: rewritten(at, 3, renumbered), "other triangles than wall_00.vtu"),
    "mirrored": (lambda at: rewritten(at, 3, mirrored), "wall_03.vtu: the wall is mirrored"),
    "torn": (lambda at: [rewritten(at, n, torn) for n in range(8)], "phase 0: surface is not closed"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_folder_with_a_fault_is_refused(closed: Path, fault: str) -> None:
    spoil, what = FAULTS[fault]
    spoil(closed)
    with pytest.raises(InputError, match=what) as refused:
        read_surfaces(closed)
    assert "\n" not in str(refused.value)


def test_open_surfaces_that_cannot_be_joined_are_refused(tmp_path: Path, ventricles: LabelledSurface) -> None:
    write_open(tmp_path, ventricles, "ply")
    for phase in range(PHASES):
        (tmp_path / f"mine_RV_ENDOCARDIAL_{phase:02d}.ply").unlink()
    with pytest.raises(InputError, match="phase 0 has epi, lv_endo; expected"):
        read_surfaces(tmp_path)

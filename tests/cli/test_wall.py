"""The command that searches a wall: it writes card and figure, and refuses what does not belong together."""

from pathlib import Path

import pytest

from heartfit.cli.main import main
from heartfit.discovery.wall_model import search
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.io.curves import write_curves
from heartfit.io.meshes import write_mesh, write_motion
from heartfit.mechanisms.scar import Scar
from heartfit.observation.shape import cavity_volumes
from tests.discovery.wall_model.test_search import searched
from tests.observation.test_regional import contraction


@pytest.fixture
def files(ventricle: VentricularMesh, tmp_path: Path) -> list[str]:
    motion = contraction(ventricle, 0.8, 0.9)
    write_mesh(tmp_path / "mesh.vtu", ventricle)
    write_motion(tmp_path / "motion.npz", motion)
    write_curves(tmp_path / "measured.csv", cavity_volumes(ventricle, motion))
    mesh, path = str(tmp_path / "mesh.vtu"), str(tmp_path / "motion.npz")
    return [str(tmp_path / "measured.csv"), "--mesh", mesh, "--motion", path]


def test_a_card_and_a_bullseye_are_written(
    files: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    scarred = searched(Scar(extent=0.24, angle=1.05), 11)
    monkeypatch.setattr(search, "search_wall", lambda model, recording: scarred)
    assert main(["diagnose-wall", *files, "-o", str(tmp_path / "out")]) == 0
    assert capsys.readouterr().out.startswith("Missing mechanism: scar")
    assert (tmp_path / "out" / "wall.md").read_text().startswith("# The wall of measured.csv")
    assert (tmp_path / "out" / "wall.png").stat().st_size > 10_000


def test_the_motion_of_another_mesh_is_refused(
    files: list[str], ventricle: VentricularMesh, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    motion = contraction(ventricle, 0.8, 0.9)
    shorter = Motion(motion.times, motion.period, motion.positions[:, :-1])
    write_motion(tmp_path / "motion.npz", shorter)
    assert main(["diagnose-wall", *files, "-o", str(tmp_path / "out")]) == 2
    nodes = len(ventricle.points)
    assert f"{nodes - 1} nodes; expected the {nodes} of the mesh" in capsys.readouterr().err


def test_an_unknown_setting_is_refused(files: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["diagnose-wall", *files, "--setting", "none"]) == 2
    assert "no setting 'none'" in capsys.readouterr().err

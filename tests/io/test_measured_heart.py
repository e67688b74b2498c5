"""A folder that is no measured heart is refused with the file and the expected content."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.io.measured_heart import read_measured_heart


def phase(folder: Path, number: int) -> Path:
    return sorted((folder / "control_points").iterdir())[number]


def drop_point(folder: Path) -> None:
    lines = phase(folder, 3).read_text().splitlines()
    phase(folder, 3).write_text("\n".join(lines[:-1]))


def write_nan(folder: Path) -> None:
    lines = phase(folder, 3).read_text().splitlines()
    phase(folder, 3).write_text("\n".join([*lines[:-1], "nan,0,0,3"]))


def drop_phases(folder: Path) -> None:
    for file in sorted((folder / "control_points").iterdir())[7:]:
        file.unlink()


def open_surface(folder: Path) -> None:
    file = folder / "template" / "ETIndicesMaterials.txt"
    file.write_text(file.read_text().replace("LV_ENDOCARDIAL", "LEFT_ATRIUM", 1))


def drop_timing(folder: Path) -> None:
    (folder / "cine" / "timing.json").unlink()


def no_short_axis(folder: Path) -> None:
    (folder / "cine" / "timing.json").write_text(json.dumps({}))


@pytest.fixture
def copy(measured_heart_folder: Path, tmp_path: Path) -> Path:
    for name in ("control_points", "template"):
        (tmp_path / name).mkdir()
        for file in (measured_heart_folder / name).iterdir():
            shutil.copyfile(file, tmp_path / name / file.name)
    (tmp_path / "cine").mkdir()
    shutil.copyfile(measured_heart_folder / "cine" / "timing.json", tmp_path / "cine" / "timing.json")
    return tmp_path


def test_the_copy_is_read_as_the_original(copy: Path, measured_heart_folder: Path) -> None:
    here, there = read_measured_heart(copy), read_measured_heart(measured_heart_folder)
    assert np.array_equal(here.positions, there.positions)
    assert here.at(9).volume() == pytest.approx(159.5e-6, rel=1e-3)


@pytest.mark.parametrize(
    ("spoil", "what"),
    [
        (drop_point, "387 control points, expected 388"),
        (write_nan, "NaN"),
        (drop_phases, "7 phases; expected at least 8"),
        (open_surface, "not closed"),
        (drop_timing, r"timing\.json: no such file"),
        (no_short_axis, "short-axis"),
    ],
)
def test_a_spoilt_folder_is_refused(copy: Path, spoil: Callable[[Path], None], what: str) -> None:
    spoil(copy)
    with pytest.raises(InputError, match=what):
        read_measured_heart(copy)


def test_an_empty_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"control_points: missing"):
        read_measured_heart(tmp_path)

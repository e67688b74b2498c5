"""Data of a measured case are read as in its jobs: end diastole first, with equal lengths of the beat."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.imaging.segmentation.stack import Segmentation
from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.io import sources
from heartfit.io.images import write_images
from heartfit.io.segmentations import write_segmentation
from heartfit.io.sources import examine, read_source_images, read_wall, source_files, stated_period
from heartfit.study.case import Case, Source
from tests.printed import numbers_in

LABELS = {"lv_cavity": 1, "lv_wall": 2, "rv_cavity": 3}
GRID = Grid((6, 5, 4), np.full(3, 2e-3), np.zeros(3), np.eye(3))
FRAMES, PERIOD = 8, 0.8
CASE = Case.model_validate({"case": "heart1", "kind": "measured", "period": PERIOD})


@pytest.fixture
def segmented(tmp_path: Path) -> Source:
    """Noise as cine, and labels in every frame; frame 3 is end diastole."""
    voxels = np.random.default_rng(0).random((FRAMES, *GRID.shape)).astype(np.float32)
    voxels += np.arange(FRAMES, dtype=np.float32)[:, None, None, None]
    times = np.arange(FRAMES) * PERIOD / FRAMES
    write_images(tmp_path / "cine.nrrd", ImageSequence(GRID, voxels, times, PERIOD))
    codes = np.random.default_rng(1).integers(0, 4, (FRAMES, *GRID.shape))
    frames = [Segmentation(GRID, {name: code == n for name, n in LABELS.items()}) for code in codes]
    write_segmentation(tmp_path / "labels.nrrd", frames, LABELS)
    files = {"segmentation": str(tmp_path / "labels.nrrd"), "images": str(tmp_path / "cine.nrrd")}
    return Source.model_validate(files | {"labels": LABELS, "end_diastole": 3})


def test_end_diastole_is_first_and_at_time_zero(segmented: Source) -> None:
    images = read_source_images(CASE, segmented)
    assert images.times[0] == 0.0
    assert int(images.voxels[0].mean()) == 3


def test_the_segmentation_of_that_frame_makes_the_wall(
    segmented: Source, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(sources, "wall_surface", lambda drawn, shaping: (drawn, shaping.right_wall))
    drawn, thickness = read_wall(segmented.model_copy(update={"rv_wall_thickness": 4e-3}))
    expected = np.random.default_rng(1).integers(0, 4, (FRAMES, *GRID.shape))[3] == 2
    assert np.array_equal(drawn.parts["lv_wall"], expected)
    assert thickness == 4e-3
    with pytest.raises(InputError, match=r"\b8 frames.*end_diastole.*\b8\b"):
        read_wall(segmented.model_copy(update={"end_diastole": FRAMES}))


def test_the_length_of_the_beat_is_the_images_or_the_row_s(segmented: Source, tmp_path: Path) -> None:
    assert stated_period(segmented) == PERIOD
    problems = examine(CASE.model_copy(update={"period": 0.9}), segmented).problems
    (problem,) = [problem for problem in problems if "period_s" in problem]
    assert problem.startswith("heart1: ")
    assert {0.9, 0.8} <= set(numbers_in(problem))
    (tmp_path / "cine.json").unlink()
    assert stated_period(segmented) is None
    assert read_source_images(CASE, segmented).period == PERIOD


def test_an_unreadable_source_does_not_hide_further_mistakes(segmented: Source, tmp_path: Path) -> None:
    (tmp_path / "labels.nrrd").write_text("no image")
    (tmp_path / "cine.nrrd").unlink()
    problems = examine(CASE, segmented).problems
    assert len(problems) == 2
    assert all(problem.startswith(f"heart1: {tmp_path}/") for problem in problems)


def test_frames_that_differ_from_the_images_are_refused(segmented: Source, tmp_path: Path) -> None:
    codes = np.random.default_rng(2).integers(0, 4, (5, *GRID.shape))
    frames = [Segmentation(GRID, {name: code == n for name, n in LABELS.items()}) for code in codes]
    write_segmentation(tmp_path / "labels.nrrd", frames, LABELS)
    problems = examine(CASE, segmented).problems
    assert sum({5.0, 8.0} <= set(numbers_in(problem)) for problem in problems) == 1


def test_a_workflow_watches_the_files_of_the_wall(segmented: Source, tmp_path: Path) -> None:
    assert source_files(segmented) == [str(tmp_path / "labels.nrrd")]
    (tmp_path / "control_points").mkdir()
    (tmp_path / "control_points" / "0.txt").touch()
    assert source_files(Source.model_validate({"fit": str(tmp_path)})) == [
        str(tmp_path / "control_points" / "0.txt")
    ]

"""Sound images and a sound pressure of the sound heart."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import SimpleITK as sitk

from heartfit.imaging.checks import ClosedSurfaces
from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.io.images import write_images
from tests.malformed.sound import PHASES, wall

VOXEL, MARGIN, PERIOD, BEAT = 5e-3, 8e-3, 0.8, 160
BRIGHTNESS = np.array([10.0, 60.0, 200.0])
"""Brightness of lung, muscle and blood."""


def sequence() -> ImageSequence:
    """The wall in front of lung, the same in every frame."""
    surface = wall()
    low = surface.points.min(axis=0) - MARGIN
    i, j, k = np.ceil((np.ptp(surface.points, axis=0) + 2 * MARGIN) / VOXEL).astype(int).tolist()
    grid = Grid((i, j, k), np.full(3, VOXEL), low, np.eye(3))
    frame = BRIGHTNESS[ClosedSurfaces.from_surfaces(surface).paint(grid, surface.points).astype(int)].astype(
        np.float32
    )
    return ImageSequence(grid, np.stack([frame] * PHASES), np.arange(PHASES) * PERIOD / PHASES, PERIOD)


def write_sources(folder: Path) -> None:
    """Images and a pressure, and configurations that name them."""
    for suffix in (".nrrd", ".nii.gz", ".mha"):
        write_images(folder / f"cine{suffix}", sequence())
    sitk.WriteImage(sitk.ReadImage(str(folder / "cine.nii.gz")), str(folder / "cine.nii"))
    (folder / "imaged.yaml").write_text("sources: {mine: {fit: heart, images: cine.nrrd}}\n")
    (folder / "p.csv").write_text(pressure())
    (folder / "own.yaml").write_text(
        "sources: {mine: {fit: heart, pressure: {file: p.csv, trigger: marker}}}\n"
    )


def dicom(
    folder: Path, change: Callable[[int, int], dict[str, str]] = lambda place, frame: {}, size: int = 6
) -> None:
    """A cine of three small slices, a file for each of 8 frames."""
    folder.mkdir(parents=True)
    for place in range(3):
        for frame in range(PHASES):
            image = sitk.GetImageFromArray(np.full((1, size, size), 100 * place + frame, np.int16))
            image.SetOrigin([0.0, 0.0, 10.0 * place])
            tags = {
                "0008|0018": f"1.2.3.{place}.{frame + 1}",
                "0008|0060": "MR",
                "0018|0050": "8",
                "0018|1060": f"{100 * frame}",
                "0018|1062": "800",
                "0020|000d": "1.2.3",
                "0020|000e": f"1.2.3.{place + 7}",
                "0020|0052": "1.2.4",
                "0020|0100": f"{frame + 1}",
            }
            for key, value in (tags | change(place, frame)).items():
                if value:
                    image.SetMetaData(key, value)
            writer = sitk.ImageFileWriter()
            writer.KeepOriginalImageUIDOn()
            writer.SetFileName(str(folder / f"{place}_{frame}.dcm"))
            writer.Execute(image)


def pressure(
    columns: str = "time_s,lv_pressure_mmhg,marker", rows: int = 400, factor: float = 1.0, step: float = 0.005
) -> str:
    """Beats of 160 samples, a step, s, apart, the second column multiplied."""
    sample = np.arange(rows)
    times, marks = step * sample, (sample % BEAT < 10).astype(int)
    values = factor * (65 - 57 * np.cos(2 * np.pi * sample / BEAT))
    lines = (f"{t:.3f},{p:.6g},{m}" for t, p, m in zip(times, values, marks, strict=True))
    return "\n".join([columns, *lines]) + "\n"

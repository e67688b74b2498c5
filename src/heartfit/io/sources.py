"""Data of a measured case: wall, images and pressure, with every mistake in them at once."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from heartfit.core.errors import InputError
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.surface import LabelledSurface
from heartfit.imaging.checks import require_match
from heartfit.imaging.segmentation.surface import wall_surface
from heartfit.imaging.segmentation.wall import Shaping
from heartfit.imaging.sequence import ImageSequence
from heartfit.io.images import read_images
from heartfit.io.measured_heart import MeasuredHeart, read_measured_heart, short_axis_images
from heartfit.io.segmentations import frames_of, read_segmentation
from heartfit.io.surface_folder import read_surfaces, surface_files
from heartfit.observation.recorded_pressure import AveragedPressure
from heartfit.study.case import Case, Source

LARGEST_PERIOD_DIFFERENCE = 0.02
"""Relative."""

IMAGE_MARGIN = -0.02
"""Margin of the images about the wall [m]; negative, because short-axis stacks often omit apex or base."""
T = TypeVar("T")


@dataclass
class Subject:
    """Data of a measured case, None where they are missing or cannot be read, and one line for each mistake.

    wall: at end diastole; heart: wall in every phase, for sources that need no registration.
    """

    case: Case
    source: Source
    heart: MeasuredHeart | None = None
    wall: LabelledSurface | None = None
    images: ImageSequence | None = None
    pressure: AveragedPressure | None = None
    problems: list[str] = field(default_factory=list)

    def attempt(self, read: Callable[..., T], *arguments: Any) -> T | None:
        """Return the result of a reader; record its InputError as a problem of this case."""
        try:
            return read(*arguments)
        except InputError as error:
            problems = [f"{self.case.case}: {problem}" for problem in error.problems]
            self.problems += [problem for problem in problems if problem not in self.problems]
            return None

    def summary(self, filling: float) -> list[str]:
        """Describe the data, one line each; filling: end-diastolic left-ventricular pressure of the study [Pa]."""
        lines = []
        if self.wall is not None:
            volumes = [
                1e6 * Cavity.from_endocardium(self.wall, name).volume(self.wall.points)
                for name in ("lv_endo", "rv_endo")
            ]
            lines.append(
                f"at end diastole {volumes[0]:.0f} mL in the left cavity, {volumes[1]:.0f} mL in the right one, "
                f"{1e6 * self.wall.volume():.0f} mL of wall"
            )
        if self.heart is not None:
            lines.append(f"surfaces in {len(self.heart.times)} phases, beat of {self.heart.period:.3f} s")
        if self.images is not None:
            size = " x ".join(map(str, self.images.grid.size))
            lines.append(
                f"images of {size} voxels in {len(self.images.times)} frames, beat of {self.images.period:.3f} s"
            )
        if self.pressure is not None:
            kept, values = self.pressure.kept, 1e-3 * self.pressure.curve.values
            origin = "end_diastolic_pressure.lv" if self.case.edp is None else "edp in its row"
            lines.append(
                f"pressure of {values.min():.1f} to {values.max():.1f} kPa, mean of {kept.sum()} of {kept.size} beats; "
                f"{1e-3 * self.pressure.end_diastolic:.2f} kPa at the trigger, the study assumes "
                f"{1e-3 * filling:.2f} kPa ({origin})"
            )
        return lines


def read_heart(source: Source) -> MeasuredHeart:
    """Read the wall in every phase from a fit or from surface meshes."""
    if source.surfaces is not None:
        return read_surfaces(Path(source.surfaces))
    return read_measured_heart(Path(source.fit or ""))


def read_wall(source: Source) -> LabelledSurface:
    """Read the wall at end diastole from a segmentation, a fit or surface meshes."""
    if source.segmentation is None or source.labels is None:
        return read_heart(source).surface
    frames = read_segmentation(Path(source.segmentation), source.labels.numbers())
    if len(frames) > 1 and source.end_diastole >= len(frames):
        raise InputError(
            f"{source.segmentation}: {len(frames)} frames, and end_diastole is {source.end_diastole}; expected one of "
            "them, counted from 0"
        )
    segmentation = frames[source.end_diastole if len(frames) > 1 else 0]
    return wall_surface(segmentation, Shaping(right_wall=source.rv_wall_thickness))


def read_source_images(case: Case, source: Source) -> ImageSequence:
    """Read the images, end diastole first and at time zero; without a stated period that of the case holds.

    Images of a source with a wall in every phase have the times of the wall.
    """
    return _images_with(case, source, None if source.segmented else read_heart(source))


def _images_with(case: Case, source: Source, heart: MeasuredHeart | None) -> ImageSequence:
    path = Path(source.images or "")
    if heart is not None:
        return read_images(path, heart.period, heart.times)
    return read_images(path, usual=case.period).starting_at(source.end_diastole)


def examine(case: Case, source: Source) -> Subject:
    """Read all data that the jobs of a case will read."""
    subject = Subject(case, source)
    if source.segmented:
        subject.wall = subject.attempt(read_wall, source)
    else:
        subject.heart = subject.attempt(read_heart, source)
    if subject.heart is not None:
        subject.wall = subject.heart.surface
        subject.attempt(_require_period, case, subject.heart.period, "the surfaces")
    if source.images is not None:
        subject.images = subject.attempt(_images_with, case, source, subject.heart)
    if subject.images is not None:
        subject.attempt(_require_period, case, subject.images.period, "the images")
        subject.attempt(frames_of, source, subject.images)
        if subject.wall is not None:
            subject.attempt(require_match, subject.images, subject.wall, IMAGE_MARGIN)
    subject.pressure = subject.attempt(_read_pressure, source, case.period)
    return subject


def with_cine(source: Source) -> Source:
    """Add the short-axis cine in the folder of a fit, unless the source has other images."""
    if source.fit is None or source.images is not None:
        return source
    images = short_axis_images(Path(source.fit))
    return source.model_copy(update={"images": None if images is None else str(images)})


def stated_period(source: Source) -> float | None:
    """Length of the beat [s], None if the data do not state it or cannot be read."""
    try:
        if source.segmented:
            return None if source.images is None else read_images(Path(source.images)).period
        return read_heart(source).period
    except InputError:
        return None


def stated_filling(source: Source, period: float | None) -> float | None:
    """Recorded end-diastolic pressure [Pa], None without a readable recording or if it is negative."""
    try:
        recorded = None if period is None else _read_pressure(source, period)
    except InputError:
        return None
    return None if recorded is None or recorded.end_diastolic < 0.0 else recorded.end_diastolic


def source_files(source: Source) -> list[str]:
    """Files of the wall, as inputs of the workflow."""
    if source.segmentation is not None:
        return [source.segmentation]
    if source.surfaces is not None:
        return [str(file) for file in surface_files(Path(source.surfaces))]
    folder = Path(source.fit or "")
    return sorted(str(file) for part in ("control_points", "template") for file in folder.glob(f"{part}/*"))


def _read_pressure(source: Source, period: float) -> AveragedPressure | None:
    from heartfit.io.pressures import read_pressure

    return None if source.pressure is None else read_pressure(source.pressure, period)


def _require_period(case: Case, period: float, origin: str) -> None:
    if abs(case.period / period - 1.0) > LARGEST_PERIOD_DIFFERENCE:
        raise InputError(
            f"period_s is {case.period:g}, {origin} state {period:.3f} s; expected the same to 2 %: correct the "
            "table of cases"
        )

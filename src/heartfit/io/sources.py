"""Reads the data of a measured case, and says at once all that is wrong with them."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from heartfit.configuration.case import Case
from heartfit.configuration.source import Source
from heartfit.errors import InputError
from heartfit.imaging.checks import require_match
from heartfit.imaging.sequence import ImageSequence
from heartfit.io.images import read_images
from heartfit.io.measured_heart import MeasuredHeart, read_measured_heart, short_axis_images
from heartfit.observation.recorded_pressure import AveragedPressure

LARGEST_PERIOD_DIFFERENCE = 0.02
OUT_OF_IMAGES = -0.02
"""m that the wall may reach out of the first and last slice: short-axis stacks often spare apex or base."""
T = TypeVar("T")


@dataclass
class Subject:
    """What the files of a measured case hold, None where they do not or cannot be read, and a line for each mistake."""

    case: Case
    source: Source
    heart: MeasuredHeart | None = None
    images: ImageSequence | None = None
    pressure: AveragedPressure | None = None
    problems: list[str] = field(default_factory=list)

    def attempt(self, read: Callable[..., T], *arguments: Any) -> T | None:
        """What a reader returns; what it refuses is kept as a problem of this case."""
        try:
            return read(*arguments)
        except InputError as error:
            self.problems += [f"{self.case.case}: {problem}" for problem in error.problems]
            return None

    def said(self, filling_pressure: float) -> list[str]:
        """What was read, a line each; filling_pressure: under which the study takes the left ventricle to stand, Pa."""
        lines = []
        if self.heart is not None:
            phases, points = self.heart.positions.shape[:2]
            lines.append(f"wall of {points} points in {phases} phases, beat of {self.heart.period:.3f} s")
        if self.images is not None:
            lines.append(
                f"images of {' x '.join(map(str, self.images.grid.size))} voxels in {len(self.images.times)} frames"
            )
        if self.pressure is not None:
            kept, values = self.pressure.kept, 1e-3 * self.pressure.curve.values
            lines.append(
                f"pressure of {values.min():.1f} to {values.max():.1f} kPa, mean of {kept.sum()} of {kept.size} beats; "
                f"{1e-3 * self.pressure.end_diastolic:.2f} kPa at the trigger, where the study says "
                f"end_diastolic_pressure.lv = {filling_pressure:g} Pa"
            )
        return lines


def read_heart(source: Source) -> MeasuredHeart:
    """The wall in every phase, of a fit or of surface meshes."""
    return read_measured_heart(Path(source.fit or ""))


def examine(case: Case, source: Source) -> Subject:
    """Read all that the jobs of a case will read."""
    subject = Subject(case, source)
    subject.heart = subject.attempt(read_heart, source)
    if subject.heart is not None:
        subject.attempt(_require_period, case, subject.heart.period, "the surfaces")
    subject.images = subject.attempt(_read_images, case, source, subject.heart)
    if subject.images is not None and subject.heart is not None:
        subject.attempt(require_match, subject.images, subject.heart.surface, OUT_OF_IMAGES)
    subject.pressure = subject.attempt(_read_pressure, case, source)
    return subject


def with_cine(source: Source) -> Source:
    """A fit comes with the short-axis cine that lies in its folder, where no other images are given."""
    if source.fit is None or source.images is not None:
        return source
    images = short_axis_images(Path(source.fit))
    return source.model_copy(update={"images": None if images is None else str(images)})


def stated_period(source: Source) -> float | None:
    """The length of the beat, s, if the data say it and can be read."""
    try:
        if source.segmented:
            return None if source.images is None else read_images(Path(source.images)).period
        return read_heart(source).period
    except InputError:
        return None


def source_files(source: Source) -> list[str]:
    """The files of the wall, for a workflow to watch."""
    folder = Path(source.fit or "")
    return sorted(str(file) for part in ("control_points", "template") for file in folder.glob(f"{part}/*"))


def _read_images(case: Case, source: Source, heart: MeasuredHeart | None) -> ImageSequence | None:
    if source.images is None:
        return None
    if heart is not None:
        return read_images(Path(source.images), heart.period, heart.times)
    return read_images(Path(source.images), case.period)


def _read_pressure(case: Case, source: Source) -> AveragedPressure | None:
    from heartfit.io.pressures import read_pressure

    return None if source.pressure is None else read_pressure(source.pressure, case.period)


def _require_period(case: Case, period: float, what: str) -> None:
    if abs(case.period / period - 1.0) > LARGEST_PERIOD_DIFFERENCE:
        raise InputError(
            f"period_s is {case.period:g}, {what} say {period:.3f} s; expected the same to 2 %: correct the table of "
            "cases"
        )

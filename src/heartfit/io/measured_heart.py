"""Reads a measured heart: control points of a biventricular subdivision surface in every phase of the beat.

Layout of the folder (as published with biv-me, Apache-2.0): `control_points/*.txt` one table of x, y, z in mm
per phase, `template/subdivision_matrix_sparse.mat`, `template/ETIndicesSorted.txt` (triangles, 1-based),
`template/ETIndicesMaterials.txt` (one label per triangle), `cine/timing.json` (beat lengths of the
acquisitions).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.motion import require_phases
from heartfit.geometry.soundness import require_heart
from heartfit.geometry.surface import LabelledSurface, enclosed_volume
from heartfit.io.image_times import BEATS
from heartfit.io.subdivision import read_template
from heartfit.io.text import read_json, read_text

MILLIMETRE = 1e-3
MILLISECOND = 1e-3
SHORT_AXIS = "cine_trufi_retro"


@dataclass(frozen=True, eq=False)
class MeasuredHeart:
    """The closed wall surface of a measured heart in every phase.

    surface: end diastole (phase 0); positions (p,n,3) m of its points in every phase; times (p,) s; period s.
    Raises InputError where wall or cavities are not those of a human heart.
    """

    surface: LabelledSurface
    positions: Floats
    times: Floats
    period: float

    def __post_init__(self) -> None:
        require_heart(self.surface, self.positions)

    def at(self, phase: int) -> LabelledSurface:
        """The wall surface in one phase."""
        return LabelledSurface(self.positions[phase], self.surface.triangles, self.surface.labels)


def read_measured_heart(folder: Path) -> MeasuredHeart:
    """Reads the wall surface of every phase from the folder of one subject.

    Raises InputError for a missing file, a surface that is not closed, unequal vertex counts, NaN, fewer than
    8 phases.
    """
    control_points = _read_control_points(_folder(folder / "control_points"))
    template = read_template(_folder(folder / "template"))
    if template.matrix.shape[1] != control_points.shape[1]:
        raise InputError(
            f"{folder}: {control_points.shape[1]} control points in each phase, expected {template.matrix.shape[1]}, "
            "the columns of the subdivision matrix; take the template the control points were fitted with"
        )
    period = _read_period(folder / "cine" / "timing.json")
    positions = np.stack([template.points(phase) for phase in control_points]) * MILLIMETRE
    positions, triangles = _only_used(positions, template.triangles)
    if enclosed_volume(positions[0], triangles) < 0.0:
        triangles = triangles[:, ::-1]
    times = np.arange(len(positions)) * period / len(positions)
    try:
        surface = LabelledSurface(positions[0], triangles, template.labels)
        return MeasuredHeart(surface, positions, times, period)
    except InputError as fault:
        raise InputError(f"{folder}: {fault}") from None


def short_axis_images(folder: Path) -> Path | None:
    """The short-axis cine that the surfaces were fitted to, one frame for each phase; None if it is not there.

    It is not published in a form that can be fetched: `cine/sax*`, a 4-D file or a folder as read_images takes it,
    perhaps with its times in JSON beside it.
    """
    found = sorted(path for path in (folder / "cine").glob("sax*") if path.suffix != ".json")
    return found[0] if found else None


def _read_control_points(folder: Path) -> Floats:
    files = sorted(folder.glob("*.txt"))
    require_phases(len(files), str(folder))
    phases = [_read_phase(file) for file in files]
    for file, phase in zip(files, phases, strict=True):
        if len(phase) != len(phases[0]):
            raise InputError(
                f"{file}: {len(phase)} control points, expected {len(phases[0])} as in {files[0].name}; "
                "every phase must be the same mesh"
            )
        if not np.isfinite(phase).all():
            raise InputError(f"{file}: holds NaN or infinite coordinates; expected finite numbers in mm")
    return np.stack(phases)


def _read_phase(file: Path) -> Floats:
    """Control points (n,3) in mm: the first three columns below a line of headings."""
    lines = read_text(file, "control points in mm").splitlines()[1:]
    try:
        return np.array([_place(line) for line in lines]).reshape(-1, 3)
    except ValueError:
        raise InputError(
            f"{file}: expected lines x,y,z,... of numbers in mm below one line of headings"
        ) from None


def _place(line: str) -> list[float]:
    x, y, z = line.split(",")[:3]
    return [float(x), float(y), float(z)]


def _only_used(positions: Floats, triangles: Integers) -> tuple[Floats, Integers]:
    """Drops the points that belong to no triangle, such as the centres of the valve discs."""
    used, renumbered = np.unique(triangles, return_inverse=True)
    return positions[:, used], renumbered.reshape(triangles.shape).astype(np.int64)


def _read_period(file: Path) -> float:
    """Mean beat length in s of the short-axis acquisitions, which the surfaces were fitted to."""
    content = read_json(file, "the beat lengths of a biv-me subject")
    given = content.values() if isinstance(content, Mapping) else ()
    beats = [
        _beat(file, each)
        for each in given
        if isinstance(each, Mapping) and each.get("description") == SHORT_AXIS
    ]
    if not beats:
        raise InputError(
            f"{file}: no acquisition is described as {SHORT_AXIS!r}; expected the short-axis cines"
        )
    return float(np.mean(beats))


def _beat(file: Path, acquisition: Mapping[str, Any]) -> float:
    """Length of a beat in s."""
    interval = acquisition.get("nominal_interval_ms")
    if not isinstance(interval, int | float) or not BEATS[0] <= interval * MILLISECOND <= BEATS[1]:
        low, high = (beat / MILLISECOND for beat in BEATS)
        raise InputError(
            f"{file}: nominal_interval_ms is {interval!r}; expected {low:g} to {high:g} ms: correct it"
        )
    return interval * MILLISECOND


def _folder(path: Path) -> Path:
    if not path.is_dir():
        raise InputError(
            f"{path}: missing; expected the folder layout of a biv-me subject; fetch the data again"
        )
    return path

"""A measured heart as a folder of surface meshes, in every phase with the same nodes and triangles.

Each phase is one closed surface whose triangles carry the cell data `label`, or three files of the same name but for
LV_ENDO, RV_ENDO and EPI in it, open at the base (see heartfit.geometry.joining); phase 0 is end diastole. Unit and
times stand in surfaces.json beside them (see heartfit.io.surface_notes).
"""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.joining import closed, joined
from heartfit.geometry.surface import LabelledSurface, enclosed_volume
from heartfit.io.image_times import settle
from heartfit.io.measured_heart import MeasuredHeart
from heartfit.io.polygons import Triangles
from heartfit.io.surface_file import LABEL, read_triangles
from heartfit.io.surface_notes import NOTES, read_notes
from heartfit.io.surface_phases import WHOLE, Phase, phases_of


def read_surfaces(folder: Path) -> MeasuredHeart:
    """The wall in every phase; raises InputError, in one line that names folder or file, for what is not one heart."""
    folder = Path(folder)
    notes, phases = read_notes(folder), phases_of(folder)
    times, period = settle(folder / NOTES, len(phases), notes.timing)
    first = {part: read_triangles(file) for part, file in phases[0].items()}
    positions = notes.scale * np.array([_points(phase, phases[0], first) for phase in phases])
    try:
        surface = _surface(positions[0], first, notes.labels)
    except InputError as fault:
        raise InputError(f"{folder}: phase 0: {fault}") from None
    used, renumbered = np.unique(surface.triangles, return_inverse=True)
    positions, triangles = positions[:, used], renumbered.reshape(-1, 3).astype(np.int64)
    _require_right_side_out(phases, positions, triangles)
    return MeasuredHeart(LabelledSurface(positions[0], triangles, surface.labels), positions, times, period)


def surface_files(folder: Path) -> list[Path]:
    """The files that read_surfaces reads."""
    return [folder / NOTES, *(file for phase in phases_of(folder) for file in phase.values())]


def _points(phase: Phase, first: Phase, expected: Mapping[str, Triangles]) -> Floats:
    """Nodes (n,3) of all parts in turn."""
    found = {part: read_triangles(file) for part, file in phase.items()}
    for part, file in phase.items():
        _require_same(file, found[part], first[part], expected[part])
    return np.vstack([each.points for each in found.values()])


def _require_same(file: Path, found: Triangles, first: Path, expected: Triangles) -> None:
    if len(found.points) != len(expected.points):
        raise InputError(
            f"{file}: {len(found.points)} nodes, expected {len(expected.points)} as in {first.name}; "
            "every phase must be the same mesh"
        )
    if not np.array_equal(found.triangles, expected.triangles):
        raise InputError(
            f"{file}: other triangles than {first.name}; every phase must be the same mesh, moved"
        )


def _surface(points: Floats, parts: Mapping[str, Triangles], names: Mapping[str, str]) -> LabelledSurface:
    """The closed surface of phase 0."""
    if WHOLE not in parts:
        start = np.cumsum([0, *(len(part.points) for part in parts.values())])
        return joined(
            points, {name: part.triangles + n for (name, part), n in zip(parts.items(), start, strict=False)}
        )
    whole = parts[WHOLE]
    if whole.labels is None:
        raise InputError(f"no cell data {LABEL!r}; expected the name of a surface for each triangle: add it")
    unknown = sorted(set(whole.labels.tolist()) - set(names))
    if unknown:
        raise InputError(
            f"labels {', '.join(unknown[:5])} are not stated in {NOTES}; known are {', '.join(names)}"
        )
    return closed(points, whole.triangles, np.array([names[label] for label in whole.labels.tolist()]))


def _require_right_side_out(phases: list[Phase], positions: Floats, triangles: Integers) -> None:
    for phase, points in zip(phases, positions, strict=True):
        if not enclosed_volume(points, triangles) > 0.0:
            raise InputError(
                f"{next(iter(phase.values()))}: the wall is mirrored or turned inside out against phase 0; "
                "expected one heart in the same coordinates in every phase"
            )

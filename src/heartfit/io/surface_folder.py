"""Measured hearts as folders of surface meshes, with the same nodes and triangles in every phase.

A phase is one closed surface whose triangles have the cell data `label`, or three files whose names differ by LV_ENDO,
RV_ENDO and EPI, open at the base (see heartfit.geometry.joining). Phase 0 is end diastole. Unit, times and meaning of
the labels are stated in surfaces.json next to the meshes:

{"unit": "mm", "period_s": 0.829, "times_s": [0.0, 0.033, ...], "labels": {"lv_endo": 1, ...}}.
"""

import re
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from heartfit.core.arrays import Floats, Integers
from heartfit.core.errors import InputError
from heartfit.geometry.joining import OPEN_SURFACES, orient_outwards, weld_surfaces
from heartfit.geometry.mesh import require_phases
from heartfit.geometry.surface import SURFACES, LabelledSurface, enclosed_volume
from heartfit.io.image_times import Timing, settle
from heartfit.io.measured_heart import MeasuredHeart
from heartfit.io.surface_file import LABEL, SUFFIXES, Triangles, read_triangles
from heartfit.io.text import read_json

WHOLE = "closed surface"
NUMBERED = re.compile(r"(.*?)(\d+)(\D*)")
PART = re.compile(r"(LV_ENDO|RV_ENDO|EPI)(CARDIAL|CARDIUM)?", re.IGNORECASE)

Phase = dict[str, Path]
"""Files of one phase: one closed surface, or one file for each of lv_endo, rv_endo and epi."""


def phases_of(folder: Path) -> list[Phase]:
    """List the files of every phase by the last number in their names; raises InputError for a missing phase."""
    if not folder.is_dir():
        raise InputError(
            f"{folder}: no such folder; expected surface meshes ({', '.join(SUFFIXES)}), one a phase"
        )
    phases: dict[int, Phase] = defaultdict(dict)
    for file in sorted(file for file in folder.iterdir() if file.suffix in SUFFIXES):
        number, part = _number_and_part(file)
        first = phases[number].setdefault(part, file)
        if first is not file:
            raise InputError(f"{file}: the same phase and part as {first.name}; remove one of the two")
    require_phases(len(phases), str(folder))
    for number in range(min(phases), max(phases) + 1):
        _require_parts(folder, number, phases)
    return [dict(sorted(phases[number].items())) for number in sorted(phases)]


def _number_and_part(file: Path) -> tuple[int, str]:
    match = NUMBERED.fullmatch(file.stem)
    if match is None:
        raise InputError(
            f"{file}: no number in its name; expected that of the phase, or another folder for it"
        )
    part = PART.search(match[1] + match[3])
    return int(match[2]), part[1].lower() if part else WHOLE


def _require_parts(folder: Path, number: int, phases: Mapping[int, Phase]) -> None:
    parts = set(phases.get(number, {}))
    if not parts:
        raise InputError(
            f"{folder}: phases {min(phases)} to {max(phases)}, but {number} is missing; export every phase"
        )
    if parts not in ({WHOLE}, set(OPEN_SURFACES)):
        raise InputError(
            f"{folder}: phase {number} has {', '.join(sorted(parts))}; expected one closed surface, or three files "
            "with LV_ENDO, RV_ENDO and EPI in their names"
        )
    if parts != set(phases[min(phases)]):
        raise InputError(
            f"{folder}: phase {number} consists of other files than phase {min(phases)}; expected the same"
        )


NOTES = "surfaces.json"
UNITS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}
KEYS = ("unit", "period_s", "times_s", "labels")


@dataclass(frozen=True)
class Notes:
    """Content of surfaces.json: scale of the coordinates [m], timing, and name of the surface by text of a label."""

    scale: float
    timing: Timing
    labels: Mapping[str, str] = field(default_factory=lambda: {name: name for name in SURFACES})


def read_notes(folder: Path) -> Notes:
    """Read the notes of a folder; raises InputError that names the file for missing, unknown or wrong entries."""
    file = folder / NOTES
    content = read_json(file, '{"unit": "mm" or "m", "period_s": ...}')
    if not isinstance(content, dict):
        raise InputError(f"{file}: expected a table in braces with {', '.join(KEYS)}: correct it")
    for key in content:
        if key not in KEYS:
            raise InputError(f"{file}: unknown key {key}; expected only {', '.join(KEYS)}")
    return Notes(
        _scale(file, content.get("unit")), _timing(file, content), _labels(file, content.get("labels"))
    )


def _scale(file: Path, unit: object) -> float:
    if not isinstance(unit, str) or unit not in UNITS:
        raise InputError(
            f"{file}: unit is {unit!r}; expected one of {', '.join(UNITS)}: say what the meshes are in"
        )
    return UNITS[unit]


def _timing(file: Path, content: Mapping[str, Any]) -> Timing:
    period, times = content.get("period_s"), content.get("times_s")
    values = [value for value in [period, *(times if isinstance(times, list) else [])] if value is not None]
    numeric = all(isinstance(value, int | float) and not isinstance(value, bool) for value in values)
    if not numeric or not (times is None or isinstance(times, list)):
        raise InputError(
            f"{file}: expected period_s, a number, and times_s, a list of numbers, in seconds: correct it"
        )
    return Timing(period, times)


def _labels(file: Path, labels: object) -> dict[str, str]:
    if labels is None:
        return {name: name for name in SURFACES}
    if (
        not isinstance(labels, dict)
        or set(labels) != set(SURFACES)
        or len(set(map(str, labels.values()))) < 4
    ):
        raise InputError(
            f"{file}: expected labels with a number of its own for each of {', '.join(SURFACES)}"
        )
    return {str(number): name for name, number in labels.items()}


def read_surfaces(folder: Path) -> MeasuredHeart:
    """Read the wall in every phase; raises InputError that names folder or file unless it is one heart."""
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
    """Files that read_surfaces reads."""
    return [folder / NOTES, *(file for phase in phases_of(folder) for file in phase.values())]


def _points(phase: Phase, first: Phase, expected: Mapping[str, Triangles]) -> Floats:
    """Nodes (n, 3) of all parts, one after another."""
    surfaces = {part: read_triangles(file) for part, file in phase.items()}
    for part, file in phase.items():
        _require_same(file, surfaces[part], first[part], expected[part])
    return np.vstack([surface.points for surface in surfaces.values()])


def _require_same(file: Path, surface: Triangles, first: Path, expected: Triangles) -> None:
    if len(surface.points) != len(expected.points):
        raise InputError(
            f"{file}: {len(surface.points)} nodes, expected {len(expected.points)} as in {first.name}; "
            "every phase must be the same mesh"
        )
    if not np.array_equal(surface.triangles, expected.triangles):
        raise InputError(f"{file}: other triangles than {first.name}; every phase must be the same mesh")


def _surface(points: Floats, parts: Mapping[str, Triangles], names: Mapping[str, str]) -> LabelledSurface:
    """Close the surface of phase 0."""
    if WHOLE not in parts:
        start = np.cumsum([0, *(len(part.points) for part in parts.values())])
        return weld_surfaces(
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
    return orient_outwards(
        points, whole.triangles, np.array([names[label] for label in whole.labels.tolist()])
    )


def _require_right_side_out(phases: list[Phase], positions: Floats, triangles: Integers) -> None:
    for phase, points in zip(phases, positions, strict=True):
        if not enclosed_volume(points, triangles) > 0.0:
            raise InputError(
                f"{next(iter(phase.values()))}: the wall is mirrored or turned inside out against phase 0; "
                "expected one heart in the same coordinates in every phase"
            )

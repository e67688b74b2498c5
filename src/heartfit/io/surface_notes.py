"""What meshes of a measured heart do not say: unit, times, and which number is which surface.

surfaces.json beside them: {"unit": "mm", "period_s": 0.829, "times_s": [0.0, 0.033], "labels": {"lv_endo": 1, ...}}.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from heartfit.errors import InputError
from heartfit.geometry.surface import SURFACES
from heartfit.io.image_times import Timing
from heartfit.io.text import read_json

NOTES = "surfaces.json"
UNITS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}
KEYS = ("unit", "period_s", "times_s", "labels")


@dataclass(frozen=True)
class Notes:
    """scale: metres in a unit of the meshes; timing; labels: the text of a label -> name of a surface."""

    scale: float
    timing: Timing
    labels: Mapping[str, str] = field(default_factory=lambda: {name: name for name in SURFACES})


def read_notes(folder: Path) -> Notes:
    """The notes of a folder; raises InputError, naming the file, for what is missing, unknown or of another kind."""
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
    numbers = [each for each in [period, *(times if isinstance(times, list) else [])] if each is not None]
    if not all(isinstance(each, int | float) and not isinstance(each, bool) for each in numbers) or not (
        times is None or isinstance(times, list)
    ):
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

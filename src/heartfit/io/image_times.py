"""Times of the frames of an image sequence, and length of the beat."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.core.periodic import BEATS
from heartfit.io.files import write_text
from heartfit.io.image_names import stem
from heartfit.io.text import read_json

KEYS = ("period_s", "times_s")
EXPECTED = '{"period_s": a number, "times_s": a list of numbers}'
LONGEST_GAP = 1.5
"""Largest time between two frames over the median; beyond it a frame is missing."""


@dataclass(frozen=True)
class Timing:
    """Statement of one source: period [s] and times of the frames after the trigger [s]; None if it has none."""

    period: float | None = None
    times: Sequence[float] | Floats | None = None


def sidecar(path: Path) -> Path:
    """JSON file next to the images at `path`: {"period_s": 0.829, "times_s": [0.0, 0.033, ...]}."""
    return path.with_name(f"{stem(path)}.json")


def read_sidecar(path: Path) -> Timing:
    """Read the sidecar of the images, empty if there is none; raises InputError if it cannot be read."""
    file = sidecar(path)
    if not file.is_file():
        return Timing()
    try:
        content = read_json(file, EXPECTED)
        _require_keys(file, content)
        period, times = (content.get(key) for key in KEYS)
        return Timing(
            None if period is None else float(period), None if times is None else [*map(float, times)]
        )
    except (ValueError, TypeError, AttributeError) as fault:
        if isinstance(fault, InputError):
            raise
        raise InputError(f"{file}: {fault}; expected {EXPECTED}") from None


def _require_keys(file: Path, content: dict[str, object]) -> None:
    """Raise InputError for a period or times in another unit; keys of other programs are ignored."""
    for key in content:
        if key.startswith(("period", "times")) and key not in KEYS:
            raise InputError(f"{file}: unknown key {key}; expected {' or '.join(KEYS)}, in seconds")


def write_sidecar(file: Path, times: Floats, period: float) -> None:
    """Write period and times without rounding."""
    write_text(file, json.dumps({"period_s": float(period), "times_s": [*map(float, times)]}) + "\n")


def settle(where: Path, count: int, *sources: Timing) -> tuple[Floats, float]:
    """Times (count,) [s] and period [s] by the first source that states them.

    Without stated times the frames are spread evenly over the period. Raises InputError without a stated period, for a
    period that no human heart has, for another number of times than `count`, and for a missing frame.
    """
    period = next((source.period for source in sources if source.period is not None), None)
    times = next(
        (np.array(source.times, dtype=float) for source in sources if source.times is not None), None
    )
    if period is None:
        notes = where if where.suffix == ".json" else sidecar(where)
        raise InputError(
            f"{where}: the length of the beat is not stated; expected the period, or "
            f'{{"period_s": ..., "times_s": [...]}} in {notes.name}: add it'
        )
    if not BEATS[0] <= period <= BEATS[1]:
        raise InputError(
            f"{where}: a beat of {period:g} s; expected {BEATS[0]:g} to {BEATS[1]:g} s: correct unit or period"
        )
    if times is None:
        times = np.arange(count) * period / count
    if times.shape != (count,):
        raise InputError(f"{where}: {times.size} times for {count} frames; expected one for each")
    require_no_gap(where, times)
    return times, float(period)


def require_no_gap(where: Path | str, times: Floats) -> None:
    """Raise InputError if two frames are much further apart than usual, in any unit."""
    steps = np.diff(times)
    if len(steps) and steps.max() > LONGEST_GAP * np.median(steps):
        gap = int(steps.argmax())
        raise InputError(
            f"{where}: frames {gap} and {gap + 1} are {steps[gap] / np.median(steps):.1f} times as far apart as usual; "
            "a frame is missing: export all of them"
        )

"""When the frames of an image sequence were taken, and how long the beat is."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.io.atomic import write_text
from heartfit.io.image_file import stem
from heartfit.io.text import read_json

KEYS = ("period_s", "times_s")
EXPECTED = '{"period_s": a number, "times_s": a list of numbers}'
LONGEST_GAP = 1.5
"""Of two frames, relative to the median; beyond it one is missing."""

BEATS = (0.2, 3.0)
"""Shortest and longest beat that is believed, s: 300 and 20 per minute."""


@dataclass(frozen=True)
class Timing:
    """What one source says: the beat's period, s, and the frames' times after the trigger, s; None if it does not."""

    period: float | None = None
    times: Sequence[float] | Floats | None = None


def sidecar(path: Path) -> Path:
    """The JSON file beside the images at `path`: {"period_s": 0.829, "times_s": [0.0, 0.033, ...]}."""
    return path.with_name(f"{stem(path)}.json")


def read_sidecar(path: Path) -> Timing:
    """What the file beside the images says, nothing if there is none; raises InputError if it cannot be read."""
    file = sidecar(path)
    if not file.is_file():
        return Timing()
    try:
        content = read_json(file, EXPECTED)
        _require_known(file, content)
        period, times = (content.get(key) for key in KEYS)
        return Timing(
            None if period is None else float(period), None if times is None else [*map(float, times)]
        )
    except (ValueError, TypeError, AttributeError) as fault:
        if isinstance(fault, InputError):
            raise
        raise InputError(f"{file}: {fault}; expected {EXPECTED}") from None


def _require_known(file: Path, content: dict[str, object]) -> None:
    """Other programs put other things there; but a time in another unit must not be passed over."""
    for key in content:
        if key.startswith(("period", "times")) and key not in KEYS:
            raise InputError(f"{file}: unknown key {key}; expected {' or '.join(KEYS)}, in seconds")


def write_sidecar(file: Path, times: Floats, period: float) -> None:
    """Write the exact numbers."""
    write_text(file, json.dumps({"period_s": float(period), "times_s": [*map(float, times)]}) + "\n")


def settle(where: Path, count: int, *said: Timing) -> tuple[Floats, float]:
    """Times (count,) s and period s from what is said, the first source that says something being believed.

    If nobody says when the frames were taken, they are evenly spread over the period. Raises InputError if nobody
    says how long the beat is, if it is no human one, for other than `count` times, and if a frame is missing.
    """
    period = next((one.period for one in said if one.period is not None), None)
    times = next((np.array(one.times, dtype=float) for one in said if one.times is not None), None)
    if period is None:
        raise InputError(
            f"{where}: nothing says how long the beat is; give the period, or "
            f'{{"period_s": ..., "times_s": [...]}} in {sidecar(where).name}'
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
    """Raises InputError where two frames are much further apart than usual, in whatever unit."""
    steps = np.diff(times)
    if len(steps) and steps.max() > LONGEST_GAP * np.median(steps):
        gap = int(steps.argmax())
        raise InputError(
            f"{where}: frames {gap} and {gap + 1} are {steps[gap] / np.median(steps):.1f} times as far apart as usual; "
            "a frame is missing: export all of them"
        )

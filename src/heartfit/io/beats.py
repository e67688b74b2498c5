"""Simulated beats and measured recordings.

A beat is two files: its curves as CSV, and its status, reason and diagnostics as JSON of the same name. A recording is
one CSV of curves.
"""

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.recording import Recording, Samples
from heartfit.heart.beat import Beat
from heartfit.io.curves import (
    KINDS,
    kind_of,
    read_sampled,
    read_table_of_curves,
    stated_period,
    write_table_of_curves,
)
from heartfit.io.results import read_result, write_result
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.personalise.setting import Setting


def write_beat(path: Path, beat: Beat, fingerprint: str) -> None:
    """Write the JSON `path` and the curves as .csv beside it, without rows for a failed beat; nodes are not kept."""
    state = {
        "status": beat.status,
        "reason": beat.reason,
        "period": beat.period,
        "trigger": beat.trigger,
        "diagnostics": beat.reproducible_diagnostics(),
    }
    write_table_of_curves(Path(path).with_suffix(".csv"), beat.time, _arrays(beat), beat.period)
    write_result(path, state, fingerprint, {"period": "s", "trigger": "s"})


def read_beat(path: Path) -> Beat:
    """Read the beat whose JSON is `path`."""
    state = read_result(path)
    time, values, _ = read_table_of_curves(Path(path).with_suffix(".csv"))
    groups: dict[str, dict[str, np.ndarray]] = {"volume": {}, "pressure": {}, "flow": {}}
    for name, array in values.items():
        kind = kind_of(name)
        groups[kind][name.removesuffix(f"_{kind}")] = array
    return Beat(time, groups["volume"], groups["pressure"], groups["flow"], **state)


def _arrays(beat: Beat) -> Mapping[str, np.ndarray]:
    if not beat.completed:
        return {name: np.empty(0) for name in KINDS}
    return beat.signals()


def read_fitted_curves(beat: Path, fitted: Path, setting: Setting) -> dict[str, Curve]:
    """Curves of the beat at an estimate as the setting's sensors record them; none of a failed beat.

    fitted: a posterior or a refit; both store their parameters under "summary".
    """
    sensors = setting.sensors(read_result(Path(fitted))["summary"]["estimate"])
    return beat_curves(read_beat(Path(beat)), sensors)


MEASURED = "MEASURED.csv"
"""File name of the recording at rest in the folder of a planted case; other conditions are NAME.csv beside it."""


def read_recording(path: Path, period: float | None = None) -> Recording:
    """Read a recording in SI units; without ``period`` [s] the file states it.

    Raises InputError that names the file for samples that a recording refuses.
    """
    times, values, period = read_sampled(path, period)
    try:
        return Recording(period, {name: _samples(name, times, array) for name, array in values.items()})
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def read_conditions(arguments: Iterable[str], period: float) -> dict[str, Recording]:
    """Read the recordings of arguments NAME=CSV by name; ``period`` [s] holds where a file states none.

    Raises InputError for an argument of another form and for a repeated name.
    """
    recordings: dict[str, Recording] = {}
    for argument in arguments:
        name, _, path = argument.partition("=")
        if not name or not path or name in recordings:
            raise InputError(
                f"condition {argument!r}: expected NAME=CSV with names that differ, as legs_raised=legs.csv"
            )
        stated = stated_period(Path(path))
        recordings[name] = read_recording(Path(path), period if stated is None else stated)
    return recordings


def _samples(name: str, times: np.ndarray, values: np.ndarray) -> Samples:
    sampled = ~np.isnan(values)
    try:
        return Samples(times[sampled], values[sampled])
    except InputError as error:
        raise InputError(f"{name}: {error}") from error

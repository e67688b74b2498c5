"""Measured recordings: one CSV of curves, and one for each further condition."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.recording import Recording, Samples
from heartfit.heart.beat import Beat
from heartfit.io.curves import read_sampled, spread_over, stated_period, write_table_of_curves

MEASURED = "MEASURED.csv"
"""File name of the recording at rest in the folder of a planted case; other conditions are NAME.csv in its folder."""


def read_recording(path: Path | str, period: float | None = None) -> Recording:
    """Read a recording in SI units; without ``period`` [s] the file states it.

    Raises InputError that names the file for samples that a recording refuses.
    """
    path = Path(path)
    times, values, period = read_sampled(path, period)
    try:
        return Recording(period, {name: _samples(name, times, array) for name, array in values.items()})
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def write_recording(path: Path | str, recording: Recording | Beat) -> None:
    """Write a recording, or a simulated beat from the R wave on, as a file that :func:`read_recording` reads.

    Raises InputError for a failed beat.
    """
    if isinstance(recording, Beat):
        recording = Recording.from_beat(recording)
    times = np.unique(np.concatenate([samples.times for samples in recording.curves.values()]))
    values = {
        name: spread_over(times, samples.times, samples.values) for name, samples in recording.curves.items()
    }
    write_table_of_curves(Path(path), times, values, recording.period)


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

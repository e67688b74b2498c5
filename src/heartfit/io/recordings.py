"""Recordings as CSV: the columns of :mod:`heartfit.io.curves`, over one beat or several."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from heartfit.diagnosis.recording import Recording, Samples
from heartfit.errors import InputError
from heartfit.io.curves import read_sampled, stated_period

MEASURED = "MEASURED.csv"
"""What the recording at rest is called where it has a folder of its own; others are NAME.csv beside it."""


def read_recording(path: Path, period: float | None = None) -> Recording:
    """The recording, SI, with the period, s, that is given or that the file states.

    Raises InputError that names the file for what a recording refuses.
    """
    times, values, period = read_sampled(path, period)
    try:
        return Recording(period, {name: _samples(name, times, array) for name, array in values.items()})
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def read_conditions(given: Iterable[str], period: float) -> dict[str, Recording]:
    """Recordings from texts NAME=CSV by name, of the ``period``, s, where their files state none.

    Raises InputError for another text and for a name given twice.
    """
    found: dict[str, Recording] = {}
    for text in given:
        name, _, path = text.partition("=")
        if not name or not path or name in found:
            raise InputError(
                f"condition {text!r}: expected NAME=CSV with names that differ, as legs_raised=legs.csv"
            )
        stated = stated_period(Path(path))
        found[name] = read_recording(Path(path), period if stated is None else stated)
    return found


def _samples(name: str, times: np.ndarray, values: np.ndarray) -> Samples:
    sampled = ~np.isnan(values)
    try:
        return Samples(times[sampled], values[sampled])
    except InputError as error:
        raise InputError(f"{name}: {error}") from error

"""Recordings as CSV: the columns of :mod:`heartfit.io.curves`, over one beat or several."""

from pathlib import Path

import numpy as np

from heartfit.diagnosis.recording import Recording, Samples
from heartfit.errors import InputError
from heartfit.io.curves import read_sampled


def read_recording(path: Path, period: float | None = None) -> Recording:
    """The recording, SI, with the period, s, that is given or that the file states.

    Raises InputError that names the file for what a recording refuses.
    """
    times, values, period = read_sampled(path, period)
    try:
        return Recording(period, {name: _samples(name, times, array) for name, array in values.items()})
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def _samples(name: str, times: np.ndarray, values: np.ndarray) -> Samples:
    sampled = ~np.isnan(values)
    try:
        return Samples(times[sampled], values[sampled])
    except InputError as error:
        raise InputError(f"{name}: {error}") from error

"""Simulated beats: their curves as CSV, and their status, reason and diagnostics as JSON of the same name."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from heartfit.heart.beat import Beat
from heartfit.io.curves import KINDS, kind_of, read_table_of_curves, write_table_of_curves
from heartfit.io.results import read_result, write_result
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.personalise.setting import Setting


def write_beat(path: Path, beat: Beat, fingerprint: str) -> None:
    """Write the JSON `path` and the curves as .csv of the same name, without rows for a failed beat, without nodes."""
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

"""The curves behind a cause card as JSON, SI: with cause.json beside them the whole diagnosis is read back."""

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from heartfit.diagnosis.cause import Diagnosis, Trace
from heartfit.io.results import read_result, write_result
from heartfit.observation.beat_phases import BeatPhases

UNITS = {"times": "s", "volumes": "m^3", "pressures": "Pa"}


def write_traces(path: Path, diagnosis: Diagnosis, fingerprint: str) -> None:
    """Write what cause.json leaves out: the curves, the period, and the phases of the beat where it has them."""
    content = {"period": diagnosis.period, "phases": diagnosis.phases, "traces": diagnosis.traces}
    write_result(path, content, fingerprint, UNITS)


def read_traces(path: Path) -> dict[str, Any]:
    """What write_traces wrote, by the names of a diagnosis; raises InputError for a missing or broken file."""
    content = read_result(path)
    return {
        "period": content["period"],
        "phases": _phases(content["phases"]),
        "traces": tuple(map(_trace, content["traces"])),
    }


def _phases(content: Mapping[str, Any] | None) -> BeatPhases | None:
    return None if content is None else BeatPhases(np.array(content["starts"]), content["period"])


def _trace(content: Mapping[str, Any]) -> Trace:
    arrays = {each.name: np.array(content[each.name]) for each in fields(Trace) if each.name != "curve"}
    return Trace(curve=content["curve"], **arrays)

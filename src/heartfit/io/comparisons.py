"""Comparisons of a true and a registered motion as JSON, one file for each sequence; read back exactly."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from heartfit.io.results import read_result, write_result
from heartfit.observation.comparison import Comparison
from heartfit.observation.curve import Curve
from heartfit.observation.pair import Pair, Reading

UNITS = {"curves": "m^3, Pa over s", "observations": "SI", "strain": "1", "point_error": "m"}
ARRAYS = ("true_strain", "registered_strain", "point_error", "point_error_of_beat", "folded")


def write_comparison(path: Path, comparison: Comparison, fingerprint: str) -> None:
    write_result(path, {"comparison": comparison}, fingerprint, UNITS)


def read_comparison(path: Path) -> Comparison:
    """Reads what write_comparison wrote; raises InputError for a missing or broken file."""
    content = read_result(path)["comparison"]
    pair = Pair(*(_reading(content["pair"][name]) for name in ("true", "measured")))
    return Comparison(pair, **{name: np.array(content[name]) for name in ARRAYS})


def _reading(content: Mapping[str, Any]) -> Reading:
    curves = {name: Curve(**curve) for name, curve in content["curves"].items()}
    return Reading(curves, content["observations"])

"""Published limits in, plausible ranges of parameters and Sobol's indices out and in."""

from math import inf
from pathlib import Path
from typing import Any

import numpy as np

from heartfit.io.results import read_result, write_result
from heartfit.io.tables import read_published
from heartfit.sensitivity.plausible import End, Limit, Plausible, PlausibleRange
from heartfit.sensitivity.sobol import SobolIndices


def read_limits(path: Path) -> list[Limit]:
    """The limits of a table with quantity, low, high and unit_si; an empty cell limits nothing."""
    table = read_published(path).fillna({"low": -inf, "high": inf})
    return [Limit(row.quantity, row.low * row.unit_si, row.high * row.unit_si) for row in table.itertuples()]


def write_ranges(path: Path, found: Plausible, fingerprint: str) -> None:
    write_result(path, {"ranges": found.ranges, "broken": found.broken}, fingerprint, {"standard": "SI"})


def read_ranges(path: Path) -> Plausible:
    content = read_result(path)
    return Plausible(tuple(map(_range, content["ranges"])), tuple(content["broken"]))


def _range(content: dict[str, Any]) -> PlausibleRange:
    ends = {name: End(**content[name]) for name in ("lowest", "highest")}
    return PlausibleRange(**{**content, **ends})


def write_sobol(path: Path, indices: SobolIndices, fingerprint: str) -> None:
    write_result(path, {"indices": indices}, fingerprint)


def read_sobol(path: Path) -> SobolIndices:
    content = read_result(path)["indices"]
    for name in ("parameters", "observations", "lost"):
        content[name] = tuple(content[name])
    for name in ("first", "total", "first_error", "total_error"):
        content[name] = np.array(content[name])
    return SobolIndices(**content)

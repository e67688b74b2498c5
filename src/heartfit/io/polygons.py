"""Triangles of a legacy VTK file of polygons, as text, which meshio does not read."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers, Names

KIND = "DATASET POLYDATA"
SECTIONS = (
    "POINTS",
    "POLYGONS",
    "VERTICES",
    "LINES",
    "TRIANGLE_STRIPS",
    "CELL_DATA",
    "POINT_DATA",
    "METADATA",
)


@dataclass(frozen=True, eq=False)
class Triangles:
    """points (n,3) in the file's unit; triangles (k,3); labels (k,) as text, if each triangle has one."""

    points: Floats
    triangles: Integers
    labels: Names | None = None


def is_polygons(file: Path) -> bool:
    """Whether a file is of this kind, by its first lines."""
    with file.open("rb") as content:
        return file.suffix == ".vtk" and KIND in content.read(1000).decode("latin-1").upper()


def read_polygons(file: Path) -> Triangles:
    """The triangles of a file; raises InputError, naming it, for binary or damaged ones and other polygons."""
    sections = _sections(file)
    try:
        points = _numbers(sections["POINTS"], 2, 3 * int(sections["POINTS"][0]), float).reshape(-1, 3)
        triangles = _triangles(sections["POLYGONS"])
        labels = _labels(sections.get("CELL_DATA", []), len(triangles))
    except (KeyError, IndexError, ValueError):
        raise InputError(
            f"{file}: expected POINTS and POLYGONS of three corners each; cut off, damaged or not triangulated: "
            "export it again"
        ) from None
    return Triangles(points, triangles, labels)


def _sections(file: Path) -> dict[str, list[str]]:
    """The words below each heading of the file."""
    head, _, body = file.read_text(encoding="latin-1").partition("POLYDATA")
    if "ASCII" not in head.upper().split():
        raise InputError(
            f"{file}: is binary; expected text, or a .ply, .stl, .obj or .vtu: export it as that"
        )
    sections: dict[str, list[str]] = {}
    words: list[str] = []
    for word in body.split():
        if word.upper() in SECTIONS:
            words = sections.setdefault(word.upper(), [])
        else:
            words.append(word)
    return sections


def _numbers(words: list[str], start: int, count: int, kind: type) -> np.ndarray:
    numbers: np.ndarray = np.array(words[start : start + count], dtype=kind)
    if len(numbers) != count:
        raise ValueError("fewer than stated")
    return numbers


def _triangles(words: list[str]) -> Integers:
    """Corners (k,3): from version 5 on below OFFSETS and CONNECTIVITY, before as 3 a b c for each triangle."""
    if words[2].upper() == "OFFSETS":
        count, size = int(words[0]), int(words[1])
        offsets = _numbers(words, 4, count, int)
        corners = _numbers(words, 4 + count + 2, size, int)
        sizes = np.diff(offsets)
    else:
        rows = _numbers(words, 2, 4 * int(words[0]), int).reshape(-1, 4)
        sizes, corners = rows[:, 0], rows[:, 1:].ravel()
    if (sizes != 3).any():
        raise ValueError("no triangles")
    triangles: Integers = corners.reshape(-1, 3).astype(np.int64)
    return triangles


def _labels(words: list[str], count: int) -> Names | None:
    """The cell data called label, as SCALARS with their LOOKUP_TABLE or as an array of a FIELD."""
    if "label" not in words:
        return None
    at = words.index("label")
    start = words.index("LOOKUP_TABLE", at) + 2 if words[at - 1] == "SCALARS" else at + 4
    return _numbers(words, start, count, str)

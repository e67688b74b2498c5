"""Triangle surfaces: .vtk, .vtu, .ply, .stl and .obj.

meshio reads all but legacy VTK files of polygons as text, which read_polygons parses.
"""

from dataclasses import dataclass
from pathlib import Path

import meshio
import numpy as np
from meshio._exceptions import CorruptionError

from heartfit.core.arrays import Floats, Integers, Names
from heartfit.core.errors import InputError
from heartfit.io.image_file import quiet
from heartfit.io.text import parsing, require_file

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
    """Points (n, 3) in the unit of the file; triangles (k, 3); labels (k,) as text, if triangles are labelled."""

    points: Floats
    triangles: Integers
    labels: Names | None = None


def is_polygons(file: Path) -> bool:
    """Return True for a legacy VTK file of polygons, by its first lines."""
    with file.open("rb") as content:
        return file.suffix == ".vtk" and KIND in content.read(1000).decode("latin-1").upper()


def read_polygons(file: Path) -> Triangles:
    """Read a legacy VTK file; raises InputError that names it for a binary or damaged file and other polygons."""
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
    """Split the file into words by section."""
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
    """Corners (k, 3): since version 5 below OFFSETS and CONNECTIVITY, before as 3 a b c for each triangle."""
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
    """Cell data "label", as SCALARS with their LOOKUP_TABLE or as an array of a FIELD."""
    if "label" not in words:
        return None
    at = words.index("label")
    start = words.index("LOOKUP_TABLE", at) + 2 if words[at - 1] == "SCALARS" else at + 4
    return _numbers(words, start, count, str)


READERS = {
    ".vtk": meshio.vtk.read,
    ".vtu": meshio.vtu.read,
    ".ply": meshio.ply.read,
    ".stl": meshio.stl.read,
    ".obj": meshio.obj.read,
}
SUFFIXES = tuple(READERS)
LABEL = "label"


def read_triangles(file: Path) -> Triangles:
    """Read a triangle surface; raises InputError that names the file if it is damaged, empty, or holds NaN."""
    require_file(file, f"a surface ({', '.join(SUFFIXES)})")
    surface = read_polygons(file) if is_polygons(file) else _by_meshio(file)
    if not len(surface.triangles):
        raise InputError(f"{file}: holds no triangles; expected a surface")
    if not (surface.triangles.min() >= 0 and surface.triangles.max() < len(surface.points)):
        raise InputError(f"{file}: triangles refer to nodes that do not exist; damaged: export it again")
    if not np.isfinite(surface.points).all():
        raise InputError(
            f"{file}: holds NaN or infinite coordinates; expected finite numbers: export it again"
        )
    return surface


def _by_meshio(file: Path) -> Triangles:
    with (
        parsing(file, f"triangles in {file.suffix} format", meshio.ReadError, CorruptionError, OSError),
        quiet(),
    ):
        mesh = READERS[file.suffix](file)
        cells, labels = mesh.cells_dict, mesh.cell_data_dict.get(LABEL, {}).get("triangle")
    others = sorted(set(cells) - {"triangle", "vertex", "line"})
    if others or "triangle" not in cells:
        raise InputError(
            f"{file}: holds {', '.join(others) or 'no cells'}; expected triangles: triangulate it"
        )
    points = np.zeros((len(mesh.points), 3))
    points[:, : mesh.points.shape[1]] = mesh.points
    triangles = cells["triangle"].astype(np.int64)
    return Triangles(
        points, triangles, None if labels is None else np.array([_text(label) for label in labels])
    )


def _text(label: object) -> str:
    """Name of a label; a whole number without decimals."""
    return str(label) if isinstance(label, str) else f"{float(np.asarray(label).item()):g}"

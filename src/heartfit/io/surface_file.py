"""One file of triangles: .vtk (polygons, as text), or what meshio reads: .vtu, .ply, .stl, .obj."""

from pathlib import Path

import meshio
import numpy as np
from meshio._exceptions import CorruptionError

from heartfit.errors import InputError
from heartfit.io.foreign import parsing
from heartfit.io.image_file import quiet
from heartfit.io.polygons import Triangles, is_polygons, read_polygons
from heartfit.io.text import require_file

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
    """The triangles of a file; raises InputError, naming it, if it is damaged, holds none, or NaN."""
    require_file(file, f"a surface ({', '.join(SUFFIXES)})")
    found = read_polygons(file) if is_polygons(file) else _by_meshio(file)
    if not len(found.triangles):
        raise InputError(f"{file}: holds no triangles; expected a surface")
    if not (found.triangles.min() >= 0 and found.triangles.max() < len(found.points)):
        raise InputError(f"{file}: triangles name nodes that are not there; damaged: export it again")
    if not np.isfinite(found.points).all():
        raise InputError(
            f"{file}: holds NaN or infinite coordinates; expected finite numbers: export it again"
        )
    return found


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
        points, triangles, None if labels is None else np.array([_text(each) for each in labels])
    )


def _text(label: object) -> str:
    """A name, or a whole number written as such."""
    return str(label) if isinstance(label, str) else f"{float(np.asarray(label).item()):g}"

"""The template of a biv-me fit: how control points make the points of a surface, its triangles and their names."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers, Names
from heartfit.geometry.soundness import require_indices
from heartfit.geometry.topology import orient
from heartfit.io.foreign import parsing
from heartfit.io.text import read_text, require_file

EXPECTED = "the template of a biv-me fit"
SURFACE_OF_LABEL = {
    "LV_ENDOCARDIAL": "lv_endo",
    "RV_FREEWALL": "rv_endo",
    "RV_SEPTUM": "rv_endo",
    "LV_EPICARDIAL": "epi",
    "RV_EPICARDIAL": "epi",
    "AORTA_VALVE_CUT": "base",
    "MITRAL_VALVE_CUT": "base",
    "PULMONARY_VALVE__CUT": "base",
    "TRICUSPID_VALVE_CUT": "base",
}


@dataclass(frozen=True, eq=False)
class Template:
    """matrix (n,c), sparse, of c control points; triangles (k,3) of the wall, turned alike; their names (k,)."""

    matrix: Any
    triangles: Integers
    labels: Names

    def points(self, control_points: Floats) -> Floats:
        """The surface's points (n,3), in the unit of the control points (c,3)."""
        points: Floats = self.matrix @ control_points
        return points


def read_template(folder: Path) -> Template:
    """The template without its valve discs; raises InputError for a file that is missing, damaged or of another one."""
    file = folder / "ETIndicesSorted.txt"
    triangles = _table(file, "three numbers of points in a line", np.int64, 3) - 1
    materials = _table(folder / "ETIndicesMaterials.txt", "a number and a name in a line", str, 2)[:, 1]
    if len(materials) != len(triangles):
        raise InputError(
            f"{folder}: {len(materials)} labels for {len(triangles)} triangles; expected one for each"
        )
    wall = np.isin(materials, list(SURFACE_OF_LABEL))
    if not wall.any():
        raise InputError(
            f"{folder}: no triangle is named {' or '.join(SURFACE_OF_LABEL)}; fetch the template again"
        )
    matrix = _matrix(folder / "subdivision_matrix_sparse.mat")
    try:
        require_indices(np.zeros((matrix.shape[0], 3)), triangles[wall])
    except InputError as fault:
        raise InputError(f"{file}: {fault}") from None
    labels = np.array([SURFACE_OF_LABEL[label] for label in materials[wall]])
    return Template(matrix, orient(triangles[wall]), labels)


def _table(file: Path, expected: str, kind: type, columns: int) -> np.ndarray:
    lines = read_text(file, EXPECTED).splitlines()
    with parsing(file, expected):
        table: np.ndarray = np.array([line.split() for line in lines if line.strip()]).astype(kind)
        if table.ndim != 2 or table.shape[1] != columns:
            raise InputError(f"{file}: {table.shape} cells; expected {expected}: fetch it again")
    return table


def _matrix(file: Path) -> Any:
    """The numbers of the matrix S alone; nothing else that the file holds is made."""
    from scipy.io import loadmat
    from scipy.io.matlab import MatReadError
    from scipy.sparse import csc_array

    require_file(file, EXPECTED)
    with parsing(file, "a sparse matrix S of numbers", MatReadError, OSError):
        matrix = csc_array(loadmat(file, variable_names=["S"], appendmat=False)["S"], dtype=float)
        matrix.check_format(full_check=True)  # an index out of range would be read from beyond the array
        if not np.isfinite(matrix.data).all():
            raise InputError(f"{file}: holds NaN or infinity; expected finite weights: fetch it again")
    return matrix

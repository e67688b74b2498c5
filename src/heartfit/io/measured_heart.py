"""Measured hearts as biv-me fits: control points of a biventricular subdivision surface in every phase of the beat.

The template maps control points to the points of the surface, and names its triangles. Layout of the folder (as
published with biv-me, Apache-2.0): `control_points/*.txt`, one table of x, y, z [mm] per phase;
`template/subdivision_matrix_sparse.mat`; `template/ETIndicesSorted.txt` (triangles, 1-based);
`template/ETIndicesMaterials.txt` (one label per triangle); `cine/timing.json` (beat lengths of the acquisitions).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from heartfit.core.arrays import Floats, Integers, Names
from heartfit.core.errors import InputError
from heartfit.core.periodic import BEATS
from heartfit.geometry.mesh import require_phases
from heartfit.geometry.soundness import require_heart, require_indices
from heartfit.geometry.surface import LabelledSurface, enclosed_volume, orient
from heartfit.io.text import parsing, read_json, read_text, require_file

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
class SubdivisionTemplate:
    """Sparse matrix (n, c) of c control points; consistently oriented wall triangles (k, 3); their names (k,)."""

    matrix: Any
    triangles: Integers
    labels: Names

    def points(self, control_points: Floats) -> Floats:
        """Points (n, 3) of the surface, in the unit of the control points (c, 3)."""
        points: Floats = self.matrix @ control_points
        return points


def read_template(folder: Path) -> SubdivisionTemplate:
    """Read a template without its valve discs; raises InputError for missing, damaged or mismatched files."""
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
    return SubdivisionTemplate(matrix, orient(triangles[wall]), labels)


def _table(file: Path, expected: str, kind: type, columns: int) -> np.ndarray:
    lines = read_text(file, EXPECTED).splitlines()
    with parsing(file, expected):
        table: np.ndarray = np.array([line.split() for line in lines if line.strip()]).astype(kind)
        if table.ndim != 2 or table.shape[1] != columns:
            raise InputError(f"{file}: {table.shape} cells; expected {expected}: fetch it again")
    return table


def _matrix(file: Path) -> Any:
    """Read the matrix S alone; no other object of the file is constructed."""
    from scipy.io import loadmat
    from scipy.io.matlab import MatReadError
    from scipy.sparse import csc_array

    require_file(file, EXPECTED)
    with parsing(file, "a sparse matrix S of numbers", MatReadError, OSError):
        matrix = csc_array(loadmat(file, variable_names=["S"], appendmat=False)["S"], dtype=float)
        matrix.check_format(full_check=True)  # an index out of range would read beyond the array
        if not np.isfinite(matrix.data).all():
            raise InputError(f"{file}: holds NaN or infinity; expected finite weights: fetch it again")
    return matrix


MILLIMETRE = 1e-3
MILLISECOND = 1e-3
SHORT_AXIS = "cine_trufi_retro"


@dataclass(frozen=True, eq=False)
class MeasuredHeart:
    """Closed wall surface of a measured heart in every phase.

    surface: at end diastole (phase 0); positions (p, n, 3) [m] of its points; times (p,) [s]; period [s].
    Raises InputError unless wall and cavities are those of a human heart.
    """

    surface: LabelledSurface
    positions: Floats
    times: Floats
    period: float

    def __post_init__(self) -> None:
        require_heart(self.surface, self.positions)

    def at(self, phase: int) -> LabelledSurface:
        """Wall surface in one phase."""
        return LabelledSurface(self.positions[phase], self.surface.triangles, self.surface.labels)


def read_measured_heart(folder: Path) -> MeasuredHeart:
    """Read the wall surface of every phase from the folder of one subject.

    Raises InputError for a missing file, a surface that is not closed, unequal vertex counts, NaN, fewer than
    8 phases.
    """
    control_points = _read_control_points(_folder(folder / "control_points"))
    template = read_template(_folder(folder / "template"))
    if template.matrix.shape[1] != control_points.shape[1]:
        raise InputError(
            f"{folder}: {control_points.shape[1]} control points in each phase, expected {template.matrix.shape[1]}, "
            "the columns of the subdivision matrix; take the template the control points were fitted with"
        )
    period = _read_period(folder / "cine" / "timing.json")
    positions = np.stack([template.points(phase) for phase in control_points]) * MILLIMETRE
    positions, triangles = _only_used(positions, template.triangles)
    if enclosed_volume(positions[0], triangles) < 0.0:
        triangles = triangles[:, ::-1]
    times = np.arange(len(positions)) * period / len(positions)
    try:
        surface = LabelledSurface(positions[0], triangles, template.labels)
        return MeasuredHeart(surface, positions, times, period)
    except InputError as fault:
        raise InputError(f"{folder}: {fault}") from None


def short_axis_images(folder: Path) -> Path | None:
    """Path of the short-axis cine that the surfaces were fitted to, one frame for each phase; None without it.

    It is `cine/sax*`, a 4-D file or a folder for read_images, with or without a sidecar.
    """
    cines = sorted(path for path in (folder / "cine").glob("sax*") if path.suffix != ".json")
    return cines[0] if cines else None


def _read_control_points(folder: Path) -> Floats:
    files = sorted(folder.glob("*.txt"))
    require_phases(len(files), str(folder))
    phases = [_read_phase(file) for file in files]
    for file, phase in zip(files, phases, strict=True):
        if len(phase) != len(phases[0]):
            raise InputError(
                f"{file}: {len(phase)} control points, expected {len(phases[0])} as in {files[0].name}; "
                "every phase must be the same mesh"
            )
        if not np.isfinite(phase).all():
            raise InputError(f"{file}: holds NaN or infinite coordinates; expected finite numbers in mm")
    return np.stack(phases)


def _read_phase(file: Path) -> Floats:
    """Control points (n, 3) [mm]: the first three columns below a line of headings."""
    lines = read_text(file, "control points in mm").splitlines()[1:]
    try:
        return np.array([_coordinates(line) for line in lines]).reshape(-1, 3)
    except ValueError:
        raise InputError(
            f"{file}: expected lines x,y,z,... of numbers in mm below one line of headings"
        ) from None


def _coordinates(line: str) -> list[float]:
    x, y, z = line.split(",")[:3]
    return [float(x), float(y), float(z)]


def _only_used(positions: Floats, triangles: Integers) -> tuple[Floats, Integers]:
    """Drop points without a triangle, such as the centres of the valve discs."""
    used, renumbered = np.unique(triangles, return_inverse=True)
    return positions[:, used], renumbered.reshape(triangles.shape).astype(np.int64)


def _read_period(file: Path) -> float:
    """Mean beat length [s] of the short-axis acquisitions that the surfaces were fitted to."""
    content = read_json(file, "the beat lengths of a biv-me subject")
    acquisitions = content.values() if isinstance(content, Mapping) else ()
    beats = [
        _beat(file, acquisition)
        for acquisition in acquisitions
        if isinstance(acquisition, Mapping) and acquisition.get("description") == SHORT_AXIS
    ]
    if not beats:
        raise InputError(
            f"{file}: no acquisition is described as {SHORT_AXIS!r}; expected the short-axis cines"
        )
    return float(np.mean(beats))


def _beat(file: Path, acquisition: Mapping[str, Any]) -> float:
    """Length of the beat of an acquisition [s]."""
    interval = acquisition.get("nominal_interval_ms")
    if not isinstance(interval, int | float) or not BEATS[0] <= interval * MILLISECOND <= BEATS[1]:
        low, high = (beat / MILLISECOND for beat in BEATS)
        raise InputError(
            f"{file}: nominal_interval_ms is {interval!r}; expected {low:g} to {high:g} ms: correct it"
        )
    return interval * MILLISECOND


def _folder(path: Path) -> Path:
    if not path.is_dir():
        raise InputError(
            f"{path}: missing; expected the folder layout of a biv-me subject; fetch the data again"
        )
    return path

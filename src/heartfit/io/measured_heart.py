"""Reads a measured heart: control points of a biventricular subdivision surface in every phase of the beat.

Layout of the folder (as published with biv-me, Apache-2.0): `control_points/*.txt` one table of x, y, z in mm
per phase, `template/subdivision_matrix_sparse.mat`, `template/ETIndicesSorted.txt` (triangles, 1-based),
`template/ETIndicesMaterials.txt` (one label per triangle), `cine/timing.json` (beat lengths of the
acquisitions).
"""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers, Names
from heartfit.geometry.motion import require_phases
from heartfit.geometry.surface import LabelledSurface, enclosed_volume
from heartfit.geometry.topology import orient

MILLIMETRE = 1e-3
MILLISECOND = 1e-3
SHORT_AXIS = "cine_trufi_retro"

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
class MeasuredHeart:
    """The closed wall surface of a measured heart in every phase.

    surface: end diastole (phase 0); positions (p,n,3) m of its points in every phase; times (p,) s; period s.
    """

    surface: LabelledSurface
    positions: Floats
    times: Floats
    period: float

    def at(self, phase: int) -> LabelledSurface:
        """The wall surface in one phase."""
        return LabelledSurface(self.positions[phase], self.surface.triangles, self.surface.labels)


def read_measured_heart(folder: Path) -> MeasuredHeart:
    """Reads the wall surface of every phase from the folder of one subject.

    Raises InputError for a missing file, a surface that is not closed, unequal vertex counts, NaN, fewer than
    8 phases.
    """
    from scipy.io import loadmat

    control_points = _read_control_points(folder / "control_points")
    triangles, labels = _read_template(folder / "template")
    matrix = loadmat(_existing(folder / "template" / "subdivision_matrix_sparse.mat"))["S"]
    if matrix.shape[1] != control_points.shape[1]:
        raise InputError(
            f"{folder}: {control_points.shape[1]} control points in each phase, expected {matrix.shape[1]}, "
            "the columns of the subdivision matrix; take the template the control points were fitted with"
        )
    positions = np.stack([matrix @ phase for phase in control_points]) * MILLIMETRE
    positions, triangles = _only_used(positions, triangles)
    if enclosed_volume(positions[0], triangles) < 0.0:
        triangles = triangles[:, ::-1]
    period = _read_period(folder / "cine" / "timing.json")
    times = np.arange(len(positions)) * period / len(positions)
    return MeasuredHeart(LabelledSurface(positions[0], triangles, labels), positions, times, period)


def short_axis_images(folder: Path) -> Path | None:
    """The short-axis cine that the surfaces were fitted to, one frame for each phase; None if it is not there.

    It is not published in a form that can be fetched: `cine/sax*`, a 4-D file or a folder as read_images takes it,
    perhaps with its times in JSON beside it.
    """
    found = sorted(path for path in (folder / "cine").glob("sax*") if path.suffix != ".json")
    return found[0] if found else None


def _read_control_points(folder: Path) -> Floats:
    files = sorted(_existing(folder).glob("*.txt"))
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
    """Control points (n,3) in mm: the first three columns below a line of headings."""
    lines = file.read_text(encoding="utf-8").splitlines()[1:]
    try:
        return np.array([[float(cell) for cell in line.split(",")[:3]] for line in lines]).reshape(-1, 3)
    except ValueError:
        raise InputError(
            f"{file}: expected lines x,y,z,... of numbers in mm below one line of headings"
        ) from None


def _read_template(folder: Path) -> tuple[Integers, Names]:
    """The triangles of the wall, consistently oriented, and their surface names; valve discs are left out."""
    triangles = np.loadtxt(_existing(folder / "ETIndicesSorted.txt"), dtype=np.int64) - 1
    materials = np.loadtxt(_existing(folder / "ETIndicesMaterials.txt"), dtype=str)[:, 1]
    if len(materials) != len(triangles):
        raise InputError(
            f"{folder}: {len(materials)} labels for {len(triangles)} triangles; expected one for each"
        )
    wall = np.isin(materials, list(SURFACE_OF_LABEL))
    labels = np.array([SURFACE_OF_LABEL[label] for label in materials[wall]])
    return orient(triangles[wall]), labels


def _only_used(positions: Floats, triangles: Integers) -> tuple[Floats, Integers]:
    """Drops the points that belong to no triangle, such as the centres of the valve discs."""
    used, renumbered = np.unique(triangles, return_inverse=True)
    return positions[:, used], renumbered.reshape(triangles.shape).astype(np.int64)


def _read_period(file: Path) -> float:
    """Mean beat length in s of the short-axis acquisitions, which the surfaces were fitted to."""
    acquisitions = json.loads(_existing(file).read_text())
    beats = [a["nominal_interval_ms"] for a in acquisitions.values() if a["description"] == SHORT_AXIS]
    if not beats:
        raise InputError(
            f"{file}: no acquisition is described as {SHORT_AXIS!r}; expected the short-axis cines"
        )
    return float(np.mean(beats)) * MILLISECOND


def _existing(path: Path) -> Path:
    if not path.exists():
        raise InputError(
            f"{path}: missing; expected the folder layout of a biv-me subject; fetch the data again"
        )
    return path

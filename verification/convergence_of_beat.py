"""Convergence of the six observations of one beat with mesh and time step.

The beat is the first one, from ventricles at rest: every row starts from the same state, and no drift between
beats mixes with the errors of space and time.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from heartfit.core.arrays import Floats
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements.body import FiniteElementBody, StepFailed
from heartfit.heart.finite_elements.unloading import unload
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.observation.beat import beat_curves
from heartfit.observation.operator import CurveFeatures, PressureFeatures, VolumeFeatures, observe

FEATURES: Mapping[str, CurveFeatures] = {"lv_volume": VolumeFeatures(), "lv_pressure": PressureFeatures()}
OBSERVATIONS = tuple(name for features in FEATURES.values() for name in features.names)
STEPS = (10e-3, 5e-3, 2.5e-3, 1.25e-3)
SCHEMES = {"backward Euler": False, "second order": True}
"""Time schemes by name; True for second order."""


@dataclass(frozen=True)
class Size:
    """Number of tetrahedra of a mesh, and volumes of its left cavity and wall at end diastole [m^3]."""

    tetrahedra: int
    EDV: float
    wall: float


@dataclass(frozen=True)
class Row:
    """Observations (SI) on a mesh at a time step [s], and CPU time of the beat [s]."""

    size: Size
    scheme: str
    time_step: float
    observed: Mapping[str, float]
    cpu_s: float

    def beside(self, finer: "Row") -> dict[str, float]:
        """Relative difference of each observation from that of a finer row."""
        return {name: self.observed[name] / finer.observed[name] - 1.0 for name in OBSERVATIONS}


def rows_of(
    heart: Heart, meshes: Iterable[VentricularMesh], loads: Floats, steps: Sequence[float] = STEPS
) -> Iterator[Row]:
    """Yield a row for each mesh, scheme and step; the meshes are at end diastole under ``loads`` (2,) [Pa].

    Raises StepFailed for a mesh without stress-free reference or a beat that fails.
    """
    for mesh in meshes:
        size = Size(
            len(mesh.tets), Cavity.from_endocardium(mesh, "lv_endo").volume(mesh.points), mesh.wall_volume()
        )
        reference = unload(mesh, heart.muscle, loads)
        for scheme, second_order in SCHEMES.items():
            for step in steps:
                numerics = Numerics(time_step=step, second_order=second_order, max_beats=1)
                yield Row(size, scheme, step, *_observed(heart, reference, numerics))


def _observed(heart: Heart, reference: VentricularMesh, numerics: Numerics) -> tuple[dict[str, float], float]:
    beat = simulate(heart, FiniteElementBody(reference, heart.muscle), numerics)
    if not beat.completed:
        raise StepFailed(f"{len(reference.tets)} tetrahedra, step {numerics.time_step:g} s: {beat.reason}")
    return observe(beat_curves(beat), FEATURES), beat.diagnostics["cpu_s"]


USUAL_STEP = 5e-3  # s
MILLILITRE, KILOPASCAL = 1e-6, 1e3
UNITS = (MILLILITRE,) * 3 + (KILOPASCAL,) * 3
PRINTED = ("V_min, mL", "q_max, mL/s", "q_min, mL/s", "P_max, kPa", "dP/dt max, kPa/s", "dP/dt min, kPa/s")


def mesh_table(rows: Sequence[Row]) -> pd.DataFrame:
    """Observations by mesh at the usual step of the last row's scheme, with their difference from the finest mesh."""
    usual = [row for row in rows if row.scheme == rows[-1].scheme and row.time_step == USUAL_STEP]
    return pd.DataFrame([_mesh_row(row, usual[-1]) for row in usual])


def step_table(rows: Sequence[Row]) -> pd.DataFrame:
    """Difference of each row from the last one on the same mesh, which has the best scheme and the shortest step."""
    return pd.DataFrame([_step_row(row, _finest_on(rows, row)) for row in rows])


def _finest_on(rows: Sequence[Row], row: Row) -> Row:
    return [other for other in rows if other.size == row.size][-1]


def _mesh_row(row: Row, finest: Row) -> dict[str, str]:
    values = (row.observed[name] / unit for name, unit in zip(OBSERVATIONS, UNITS, strict=True))
    off = row.beside(finest).values()
    cells = [f"{value:.4g} ({100 * part:+.1f} %)" for value, part in zip(values, off, strict=True)]
    return {
        "tetrahedra": str(row.size.tetrahedra),
        "EDV, mL": f"{row.size.EDV / MILLILITRE:.1f}",
        "wall, mL": f"{row.size.wall / MILLILITRE:.1f}",
        **dict(zip(PRINTED, cells, strict=True)),
    }


def _step_row(row: Row, finest: Row) -> dict[str, str]:
    names = (name.split(",")[0] for name in PRINTED)
    off = (f"{100 * part:+.2f} %" for part in row.beside(finest).values())
    return {
        "tetrahedra": str(row.size.tetrahedra),
        "scheme": row.scheme,
        "step, ms": f"{1e3 * row.time_step:g}",
        **dict(zip(names, off, strict=True)),
        "CPU s": f"{row.cpu_s:.1f}",
    }

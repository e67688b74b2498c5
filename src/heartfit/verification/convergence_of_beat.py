"""What a finer mesh and a shorter time step still change in the six observations of one beat.

The beat is the first one, from ventricles at rest: every row starts from the same state, and no drift between
beats mixes with the errors of space and time.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from heartfit.geometry.arrays import Floats
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart import Heart
from heartfit.mechanics.body import FiniteElementBody, StepFailed
from heartfit.mechanics.unloading import unload
from heartfit.observation.beat import beat_curves
from heartfit.observation.operator import CurveFeatures, PressureFeatures, VolumeFeatures
from heartfit.observation.vector import observe
from heartfit.simulation import Numerics, simulate

FEATURES: Mapping[str, CurveFeatures] = {"lv_volume": VolumeFeatures(), "lv_pressure": PressureFeatures()}
OBSERVATIONS = tuple(name for features in FEATURES.values() for name in features.names)
STEPS = (10e-3, 5e-3, 2.5e-3, 1.25e-3)
SCHEMES = {"backward Euler": False, "second order": True}
"""Time schemes by name, and whether they are of second order."""


@dataclass(frozen=True)
class Size:
    """Tetrahedra of a mesh and the volumes, m^3, of its left cavity and wall at end diastole."""

    tetrahedra: int
    EDV: float
    wall: float


@dataclass(frozen=True)
class Row:
    """Observations, SI, on a mesh at a time step, s; CPU time of the beat, s."""

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
    """A row for each mesh, scheme and step; the meshes are at end diastole under ``loads`` (2,), Pa.

    Raises StepFailed for a mesh without stress-free reference or a beat that fails.
    """
    for mesh in meshes:
        size = Size(len(mesh.tets), Cavity.of(mesh, "lv_endo").volume(mesh.points), mesh.wall_volume())
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


def coarsest_within(rows: Sequence[Row], largest: float) -> Row | None:
    """The first of rows on ever finer meshes that is within ``largest`` of the last one in all observations."""
    finest = rows[-1]
    near = (row for row in rows[:-1] if max(map(abs, row.beside(finest).values())) <= largest)
    return next(near, None)

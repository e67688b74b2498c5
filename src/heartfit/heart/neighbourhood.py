"""Neighbours of a heart whose wall was measured under load, each a little further along one coordinate."""

from collections.abc import Sequence
from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements.body import FiniteElementBody
from heartfit.heart.finite_elements.unloading import LoadedWall, unload_neighbours
from heartfit.heart.heart import Heart


@dataclass(frozen=True, eq=False)
class LoadedHeart:
    """A heart in a ``mesh`` that was measured under the pressures ``loads`` (2,) [Pa] in its ventricles."""

    heart: Heart
    mesh: VentricularMesh
    loads: Floats

    @property
    def wall(self) -> LoadedWall:
        """The measured wall, of the muscle of the heart."""
        return LoadedWall(self.mesh, self.heart.muscle, self.loads)


@dataclass(frozen=True, eq=False)
class Neighbour:
    """A heart and its ventricles, ``size`` away from another heart along one coordinate."""

    heart: Heart
    body: FiniteElementBody
    size: float


def surround(
    centre: LoadedHeart, others: Sequence[LoadedHeart], size: float, unloaded: bool = True
) -> tuple[FiniteElementBody, list[Neighbour]]:
    """Ventricles of a heart, and the neighbours of it that ``others`` are, at the distance ``size``.

    A neighbour whose relaxed wall differs has a stress-free reference of its own; without ``unloaded`` every measured
    wall is assumed to be stress-free. Raises StepFailed without a stress-free reference.
    """
    reference, shapes = centre.mesh, [other.mesh for other in others]
    if unloaded:
        reference, shapes = _references(centre.wall, [other.wall for other in others])
    body = FiniteElementBody(reference, centre.heart.muscle)
    return body, [
        Neighbour(other.heart, FiniteElementBody(shape, other.heart.muscle, body.elimination), size)
        for other, shape in zip(others, shapes, strict=True)
    ]


def _references(
    wall: LoadedWall, others: Sequence[LoadedWall]
) -> tuple[VentricularMesh, list[VentricularMesh]]:
    """Stress-free mesh of a wall, and those of ``others``, the same where they rest like it."""
    own = [not other.rests_like(wall) for other in others]
    differing = [other for other, differs in zip(others, own, strict=True) if differs]
    reference, rebuilt = unload_neighbours(wall, differing)
    remaining = iter(rebuilt)
    return reference, [next(remaining) if differs else reference for differs in own]

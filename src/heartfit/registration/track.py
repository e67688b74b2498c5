"""Follows the end-diastolic mesh through a sequence of images.

Every frame is matched to the first, end diastole, so that errors do not add up; a frame's search begins where its
neighbour's ended, forwards from end diastole to the middle of the sequence and backwards from its end. Brightness is
compared in the wall and a little beyond it: what lies further away does not move with the heart.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import distance_transform_edt
from threadpoolctl import threadpool_limits

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.mesh import VentricularMesh, element_volumes
from heartfit.geometry.motion import Motion
from heartfit.imaging.resample import cropped, isotropic
from heartfit.imaging.sequence import ImageSequence
from heartfit.imaging.wall import wall_voxels
from heartfit.registration.free_form import minimise
from heartfit.registration.lattice import Lattice
from heartfit.registration.level import Level
from heartfit.registration.matching import FreeForm as FreeForm
from heartfit.registration.order import in_turn
from heartfit.registration.terms import Bending, Brightness, FixedImage, WallVolume
from heartfit.registration.unfold import unfolded

STIFFER, ATTEMPTS = 10.0, 3
"""By how much the stiffness grows where a frame folds the wall, and how often that is tried."""

PRIOR_BLOCK = 2
"""Voxels a side of the blocks over which the wall keeps its volume."""

SURROUNDINGS = 4e-3
"""How far beyond what is compared the images are kept, m."""

RANGE = (1.0, 99.0)
"""Percentiles of end diastole about the wall that count as darkest and brightest."""


@dataclass(frozen=True, eq=False)
class Tracking:
    """A mesh carried by registration.

    motion: of the mesh; mismatch (p,): root mean square difference of brightness where it is compared, over the
    range of brightness at end diastole; compression (p,): least volume of a tetrahedron over that at end diastole;
    unfolded (p,): how many nodes do not follow the images, because they would have folded the wall.
    """

    motion: Motion
    mismatch: Floats
    compression: Floats
    unfolded: Integers


def track(sequence: ImageSequence, mesh: VentricularMesh, settings: FreeForm) -> Tracking:
    """Carries a mesh that stands in the first frame of a sequence through the others.

    Raises InputError, with the frames named, where the wall is folded (a tetrahedron turned inside out) even by the
    stiffest displacement.
    """
    with threadpool_limits(1):  # threads would change the last bits of sums, and cost more than they save
        return _track(sequence, mesh, settings)


def _track(sequence: ImageSequence, mesh: VentricularMesh, settings: FreeForm) -> Tracking:
    cubes = isotropic(cropped(sequence, mesh.points, settings.reach + SURROUNDINGS))
    tracker = _Tracker(cubes, mesh, settings)
    count = len(cubes.times)
    found = {0: (tracker.lattice.zeros(), 0.0)}
    for frame, neighbour in in_turn(count):
        found[frame] = tracker.follow(frame, found[neighbour][0])
    coefficients, mismatch = zip(*(found[frame] for frame in range(count)), strict=True)
    positions = np.array([tracker.places(each) for each in coefficients])
    otherwise = [
        (tracker.nodes(c) != p).any(axis=1).sum() for c, p in zip(coefficients, positions, strict=True)
    ]
    compression = np.array([tracker.compression(each) for each in positions])
    _require_unfolded(compression)
    motion = Motion(sequence.times, sequence.period, positions)
    return Tracking(motion, np.array(mismatch), compression, np.array(otherwise))


class _Tracker:
    """The frames, the mesh that stands in the first of them, and the lattice that moves it."""

    def __init__(self, sequence: ImageSequence, mesh: VentricularMesh, settings: FreeForm) -> None:
        self._grid, self._mesh, self._settings = sequence.grid, mesh, settings
        unit, shape = float(self._grid.spacing[0]), self._grid.shape
        wall = wall_voxels(self._grid, mesh)
        near = distance_transform_edt(~wall) * unit <= settings.reach
        low, high = np.percentile(sequence.voxels[0][near], RANGE)
        self._frames = (sequence.voxels - low) / (high - low)
        self.lattice = Lattice(shape, settings.knots / unit)
        self._levels = [
            (FixedImage(self.lattice, Level.of(shape, shrink), self._frames[0], near), steps)
            for shrink, steps in settings.levels
        ]
        self._volume = WallVolume(
            self.lattice, Level.of(shape, PRIOR_BLOCK), wall.astype(float), settings.incompressibility
        )
        self._stiffness = settings.stiffness / unit**2
        self._places = self._grid.index(mesh.points)[:, ::-1]

    def follow(self, frame: int, start: Floats) -> tuple[Floats, float]:
        """Coefficients of a frame and its mismatch; stiffer ones where they fold the wall and that is not undone."""
        for attempt in range(ATTEMPTS):
            bending = Bending(self.lattice, self._stiffness * STIFFER**attempt)
            coefficients = start
            for fixed, steps in self._levels:
                brightness = Brightness(fixed, self._frames[frame])
                coefficients = minimise([brightness, self._volume, bending], coefficients, steps)
            if self.compression(self.places(coefficients)) > 0.0:
                break
        return coefficients, brightness.mismatch(coefficients)

    def nodes(self, coefficients: Floats) -> Floats:
        """Where the mesh's nodes (n,3) are, m."""
        steps = self.lattice.at(coefficients, self._places)
        return self._mesh.points + self._grid.vectors(steps[:, ::-1])

    def places(self, coefficients: Floats) -> Floats:
        """The same without folds, m."""
        return unfolded(self._mesh, self.nodes(coefficients))

    def compression(self, positions: Floats) -> float:
        """Least volume of a tetrahedron over that at end diastole."""
        return float((element_volumes(positions, self._mesh.tets) / self._mesh.element_volumes()).min())


def _require_unfolded(compression: Floats) -> None:
    folded = np.flatnonzero(~(compression > 0.0))
    if len(folded):
        raise InputError(
            f"registration: frames {folded.tolist()} fold the wall (a tetrahedron is turned inside out); expected a "
            "motion without folds: look at these images, or make the registration stiffer"
        )

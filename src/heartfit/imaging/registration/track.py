"""Free-form registration that follows the end-diastolic mesh through a sequence of images.

Every frame is matched to the first, end diastole, so that errors do not accumulate; the search in a frame starts from
the result of its neighbour, forwards from end diastole to the middle of the sequence and backwards from its end.
Brightness is compared in the wall and a little beyond it: tissue further away does not move with the heart.

The sum of squares is minimised over the coefficients of a lattice by Gauss-Newton steps. Conjugate gradients solve the
linear system of each step without a matrix: a product is a displacement of the lattice and its transpose.

A displacement smooth enough for images may still fold a tetrahedron: where a strong apex closes, the images move by
more than the height of a tetrahedron within its width. A stiffer displacement would hold back the whole wall. Instead,
the nodes of such tetrahedra move by the mean over the tetrahedra about them, repeatedly, until all tetrahedra have some
volume left. Where this takes many nodes the displacement itself is at fault and is left as it is.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import distance_transform_edt
from scipy.sparse.linalg import LinearOperator, cg
from threadpoolctl import threadpool_limits

from heartfit.core.arrays import Floats, Integers
from heartfit.core.errors import InputError
from heartfit.geometry.mesh import Motion, VentricularMesh, element_volumes
from heartfit.imaging.raster import wall_voxels
from heartfit.imaging.registration import FreeForm as FreeForm
from heartfit.imaging.registration import registration_order
from heartfit.imaging.registration.lattice import Lattice
from heartfit.imaging.registration.terms import (
    Bending,
    Brightness,
    FixedImage,
    Linearised,
    PyramidLevel,
    Term,
    WallVolume,
    total,
)
from heartfit.imaging.sampling import ROUNDING, crop, resample_isotropic
from heartfit.imaging.sequence import ImageSequence

INNER_STEPS, INNER_TOLERANCE = 10, 1e-2
"""Largest number of conjugate-gradient steps, and their relative tolerance."""
MIN_RELATIVE_DECREASE = 2e-3
"""Relative decrease of the sum below which the iteration ends."""
MIN_STEP_SHARE = 0.1
"""Share of a step below which the line search ends."""
MIN_VOLUME_RATIO = 0.05
"""Volume of a tetrahedron, over that at end diastole, below which its nodes are relaxed."""
MAX_RELAXED_SHARE = 0.05
"""Largest share of the nodes that may be relaxed."""
MAX_SWEEPS = 50
"""Largest number of sweeps of relaxation."""
STIFFENING_FACTOR, MAX_ATTEMPTS = 10.0, 3
"""Factor by which the stiffness grows where a frame folds the wall, and the number of attempts."""
PRIOR_BLOCK = 2
"""Voxels along the side of the blocks over which the wall keeps its volume."""
CROP_MARGIN = 4e-3
"""Width [m] of the images that is kept beyond the compared region."""
BRIGHTNESS_PERCENTILES = (1.0, 99.0)
"""Percentiles of brightness about the wall at end diastole that count as darkest and brightest."""


def minimise(terms: Sequence[Term], start: Floats, steps: int) -> Floats:
    """Minimise a sum of terms in at most so many steps, each halved until the sum decreases."""
    coefficients, here = start, [term.linearise(start) for term in terms]
    for _ in range(steps):
        before, step, share = _sum_of_values(here), _gauss_newton(here), 1.0
        there = [term.linearise(coefficients + step) for term in terms]
        while _sum_of_values(there) > before and share > MIN_STEP_SHARE:
            share *= 0.5
            there = [term.linearise(coefficients + share * step) for term in terms]
        if _sum_of_values(there) > before:
            break
        coefficients, here = coefficients + share * step, there
        if _sum_of_values(here) > (1.0 - MIN_RELATIVE_DECREASE) * before:
            break
    return coefficients


def _sum_of_values(terms: Sequence[Linearised]) -> float:
    return sum(term.value for term in terms)


def _gauss_newton(terms: Sequence[Linearised]) -> Floats:
    """Return the step (shape of the coefficients) to the minimum of the linearised terms."""
    force, diagonal = total(term.force for term in terms), total(term.diagonal for term in terms)
    shape, size = force.shape, force.size
    # a control point without voxels has no force, so any divisor leaves it at rest
    weights = np.where(diagonal > 0.0, diagonal, 1.0).ravel()

    def curvature(flat: Floats) -> Floats:
        step = flat.reshape(shape)
        return total(term.curvature(step) for term in terms).ravel()

    system = LinearOperator((size, size), matvec=curvature, dtype=np.float32)
    scale = LinearOperator((size, size), matvec=lambda flat: flat / weights, dtype=np.float32)
    flat, _ = cg(system, force.ravel(), rtol=INNER_TOLERANCE, maxiter=INNER_STEPS, M=scale)
    step: Floats = flat.reshape(shape).astype(np.float32)
    return step


def unfold(mesh: VentricularMesh, positions: Floats) -> Floats:
    """Return positions (n, 3) [m] of the nodes without folds, or the input where that takes too many nodes."""
    displacement, before = positions - mesh.points, mesh.element_volumes()
    relaxed = np.zeros(len(positions), dtype=bool)
    for _ in range(MAX_SWEEPS):
        flat = element_volumes(mesh.points + displacement, mesh.tets) < MIN_VOLUME_RATIO * before
        if not flat.any():
            break
        nodes = np.unique(mesh.tets[flat])
        relaxed[nodes] = True
        if relaxed.mean() > MAX_RELAXED_SHARE:
            return positions
        displacement[nodes] = _neighbour_mean(mesh, displacement)[nodes]
    return np.where(relaxed[:, None], mesh.points + displacement, positions)


def _neighbour_mean(mesh: VentricularMesh, values: Floats) -> Floats:
    """Mean (n, 3) over the tetrahedra that meet in each node of the values (n, 3) at their nodes."""
    total, corners = np.zeros_like(values), mesh.tets
    np.add.at(total, corners, values[corners].mean(axis=1)[:, None])
    mean: Floats = total / np.bincount(corners.ravel(), minlength=len(values))[:, None]
    return mean


@dataclass(frozen=True, eq=False)
class Tracking:
    """Motion of a mesh by registration, and its quality.

    motion: of the mesh; mismatch (p,): root mean square difference of brightness where it is compared, over the
    range of brightness at end diastole [1]; compression (p,): smallest volume of a tetrahedron over that at end
    diastole [1]; unfolded (p,): number of nodes that do not follow the images, because they would fold the wall.
    """

    motion: Motion
    mismatch: Floats
    compression: Floats
    unfolded: Integers


def track(sequence: ImageSequence, mesh: VentricularMesh, settings: FreeForm) -> Tracking:
    """Carry a mesh in the first frame of a sequence through the other frames.

    Raises InputError, with the numbers of the frames, where even the stiffest displacement folds the wall (inverts a
    tetrahedron).
    """
    with threadpool_limits(1):  # threads change the last bits of sums and are slower
        return _track(sequence, mesh, settings)


def _track(sequence: ImageSequence, mesh: VentricularMesh, settings: FreeForm) -> Tracking:
    cubes = resample_isotropic(crop(sequence, mesh.points, settings.reach + CROP_MARGIN))
    tracker = _Tracker(cubes, mesh, settings)
    count = len(cubes.times)
    results = {0: (tracker.lattice.zeros(), 0.0)}
    for frame, neighbour in registration_order(count):
        results[frame] = tracker.follow(frame, results[neighbour][0])
    coefficients, mismatch = zip(*(results[frame] for frame in range(count)), strict=True)
    positions = np.array([tracker.positions(frame) for frame in coefficients])
    unfolded = [
        (tracker.nodes(c) != p).any(axis=1).sum() for c, p in zip(coefficients, positions, strict=True)
    ]
    compression = np.array([tracker.compression(points) for points in positions])
    _require_unfolded(compression)
    motion = Motion(sequence.times, sequence.period, positions)
    return Tracking(motion, np.array(mismatch), compression, np.array(unfolded))


class _Tracker:
    """Frames, the mesh in the first of them, and the lattice that moves it."""

    def __init__(self, sequence: ImageSequence, mesh: VentricularMesh, settings: FreeForm) -> None:
        self._grid, self._mesh = sequence.grid, mesh
        unit, shape = float(self._grid.spacing[0]), self._grid.shape
        wall = wall_voxels(self._grid, mesh)
        near = distance_transform_edt(~wall) <= settings.reach / unit + ROUNDING
        low, high = np.percentile(sequence.voxels[0][near], BRIGHTNESS_PERCENTILES)
        self._frames = (sequence.voxels - low) / (high - low)
        self.lattice = Lattice(shape, settings.knots / unit)
        self._levels = [
            (FixedImage(self.lattice, PyramidLevel.from_shape(shape, shrink), self._frames[0], near), steps)
            for shrink, steps in settings.levels
        ]
        self._volume = WallVolume(
            self.lattice,
            PyramidLevel.from_shape(shape, PRIOR_BLOCK),
            wall.astype(float),
            settings.incompressibility,
        )
        self._stiffness = settings.stiffness / unit**2
        self._places = self._grid.index(mesh.points)[:, ::-1]

    def follow(self, frame: int, start: Floats) -> tuple[Floats, float]:
        """Fit a frame: its coefficients and mismatch; stiffer ones where folds of the wall cannot be undone."""
        for attempt in range(MAX_ATTEMPTS):
            bending = Bending(self.lattice, self._stiffness * STIFFENING_FACTOR**attempt)
            coefficients = start
            for fixed, steps in self._levels:
                brightness = Brightness(fixed, self._frames[frame])
                coefficients = minimise([brightness, self._volume, bending], coefficients, steps)
            if self.compression(self.positions(coefficients)) > 0.0:
                break
        return coefficients, brightness.mismatch(coefficients)

    def nodes(self, coefficients: Floats) -> Floats:
        """Positions (n, 3) [m] of the nodes of the mesh."""
        steps = self.lattice.evaluate(coefficients, self._places)
        return self._mesh.points + self._grid.vectors(steps[:, ::-1])

    def positions(self, coefficients: Floats) -> Floats:
        """Positions (n, 3) [m] of the nodes without folds."""
        return unfold(self._mesh, self.nodes(coefficients))

    def compression(self, positions: Floats) -> float:
        """Smallest volume of a tetrahedron over that at end diastole [1]."""
        return float((element_volumes(positions, self._mesh.tets) / self._mesh.element_volumes()).min())


def _require_unfolded(compression: Floats) -> None:
    folded = np.flatnonzero(~(compression > 0.0))
    if len(folded):
        raise InputError(
            f"registration: frames {folded.tolist()} fold the wall (a tetrahedron is inverted); expected a "
            "motion without folds: look at these images, or make the registration stiffer"
        )

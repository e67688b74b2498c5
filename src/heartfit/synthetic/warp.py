r"""Real images that move as a simulation does, as in section 4.3 of the paper.

A frame shows at the place x the brightness of the material point X(x) that the simulation brought there,

.. math:: I_t(x) = I(X_t(x)) ,

where I is the real stack at end diastole. **In the wall** X is linear in every deformed tetrahedron, that is, exact.
**Around it** and in the cavities, which have no tetrahedra, the displacement X - x is harmonic: it continues that of
the wall and decays to zero on a box MARGIN beyond the heart. **Through the plane** the base descends by a centimetre
while slices lie further apart than that, so I is taken between slices (:mod:`heartfit.imaging.between_slices`). A
real slice already is a mean over its thickness; therefore each slice is sampled in its middle only, and frame 0 of a
heart at rest is the real image.

The brightness is that of the first frame, whose noise then moves with the tissue, or that of each frame's own image,
which registration has carried back to the first frame: then noise, flow and contrast change from frame to frame as
they really do. For comparison, a phantom is imaged in slices of the same distance.

References
----------
Marchesseau et al. 2012, section 4.3. Prakosa A et al. 2013, IEEE Trans Med Imaging 32:99: such sequences of real
images, by authors of the paper.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import Literal

import numpy as np
from scipy.ndimage import map_coordinates
from scipy.sparse import csr_array, eye_array, kron
from scipy.sparse import diags_array as diagonals
from scipy.sparse.linalg import cg

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.imaging.between_slices import BetweenSlices
from heartfit.imaging.raster import paint_wall
from heartfit.imaging.registration.slices import SliceMotion
from heartfit.imaging.registration.track import FreeForm, track
from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.observation.comparison import Comparison, compare_motions
from heartfit.observation.operator import CurveFeatures
from heartfit.synthetic.cine import image_beat
from heartfit.synthetic.scanner import Scanner

MARGIN, SPACING = 30e-3, 3e-3
"""Distance [m] beyond the heart at which the displacement is zero, and of the points at which it is harmonic."""
TOLERANCE = 1e-3
"""Relative tolerance of the harmonic displacement."""
RAMPS = tuple(np.indices((2, 2, 2)).astype(float)[::-1])
"""Arrays (2, 2, 2) whose value is the index i, j or k."""

Content = Literal["first", "every", "phantom"]
"""Brightness of the first real frame, of every real frame, and of a phantom."""
PHANTOM_SEED = 1


def moving_images(
    content: Content,
    images: ImageSequence,
    slices: SliceMotion,
    mesh: VentricularMesh,
    motion: Motion,
    scanner: Scanner,
) -> ImageSequence:
    """Return images that move as simulated.

    images: real; slices: their registered motion; mesh: of the wall in the first frame; motion: simulated, of its
    nodes, at the frames of the images; scanner: of the phantom.
    """
    if content == "phantom":
        return image_beat(mesh.with_points(motion.positions[0]), motion, scanner, PHANTOM_SEED)
    first = np.broadcast_to(images.voxels[0], images.voxels.shape)
    return warp_cine(images, slices.carry_back(images) if content == "every" else first, mesh, motion)


def scanner_like(images: ImageSequence, thickness: float, scanner: Scanner) -> Scanner:
    """Return a scanner with the frames, pixels and slice distance of images, whose slices have this thickness [m]."""
    width, step = float(images.grid.spacing[0]), float(images.grid.spacing[2])
    frames, gap = len(images.times), step - thickness
    return replace(scanner, frames=frames, voxel=width, slice_thickness=thickness, slice_gap=gap)


def warp_cine(images: ImageSequence, still: Floats, mesh: VentricularMesh, motion: Motion) -> ImageSequence:
    """Return the images of a heart that moves as simulated, with the brightness of real ones.

    images: real, distant slices; still (p, k, j, i): their brightness in every frame at the positions of the first;
    mesh: of the wall in the first frame; motion: simulated, of its nodes, at the frames of the images. Raises
    InputError if the numbers of frames differ.
    """
    if len(motion.times) != len(images.times):
        raise InputError(
            f"warp: {len(motion.times)} simulated and {len(images.times)} real frames; expected the same frames"
        )
    between, surroundings = BetweenSlices.of(images.voxels[0]), Surroundings.about(images.grid, motion)
    frames, displacement = [], surroundings.rest()
    for positions, stack in zip(motion.positions, still, strict=True):
        displacement = surroundings.extend(mesh, positions, displacement)
        material = surroundings.material(images.grid, mesh, positions, displacement)
        frames.append(between.brightness(stack, images.grid.index(material)))
    return replace(
        images, voxels=np.array(frames, dtype=np.float32), times=motion.times, period=motion.period
    )


class Surroundings:
    """Cubic grid about a moving heart, on which the displacement to the material point is harmonic."""

    def __init__(self, grid: Grid) -> None:
        self.grid = grid

    @classmethod
    def about(cls, images: Grid, motion: Motion) -> "Surroundings":
        """Plan the grid along the axes of the images."""
        places = motion.positions.reshape(-1, 3) @ images.direction
        low, high = places.min(axis=0) - MARGIN, places.max(axis=0) + MARGIN
        i, j, k = np.ceil((high - low) / SPACING).astype(int) + 1
        return cls(
            Grid((int(i), int(j), int(k)), np.full(3, SPACING), images.direction @ low, images.direction)
        )

    @cached_property
    def _laplacian(self) -> csr_array:
        """Minus the second differences along all axes; beyond the grid the displacement is zero."""
        steps = [diagonals([-1.0, 2.0, -1.0], offsets=[-1, 0, 1], shape=(n, n)) for n in self.grid.shape]
        k, j, i = steps
        ones = [eye_array(n) for n in self.grid.shape]
        along_k = kron(k, kron(ones[1], ones[2]))
        along_j, along_i = kron(ones[0], kron(j, ones[2])), kron(ones[0], kron(ones[1], i))
        return csr_array(along_k + along_j + along_i)

    def rest(self) -> Floats:
        """Zero displacement (k, j, i, 3)."""
        return np.zeros((*self.grid.shape, 3))

    def extend(self, mesh: VentricularMesh, positions: Floats, start: Floats) -> Floats:
        """Displacement (k, j, i, 3) [m] from each point to its material point, with the nodes at ``positions``.

        start (k, j, i, 3): a displacement from which the solution of the linear system begins.
        """
        known = material_points(self.grid, mesh, positions) - voxel_centres(self.grid)
        values = known.reshape(-1, 3)
        inside = ~np.isnan(values[:, 0])
        rows = self._laplacian[~inside]
        matrix, coupling = rows[:, ~inside], rows[:, inside]
        result = np.where(inside[:, None], values, start.reshape(-1, 3))
        for axis in range(3):
            right = -(coupling @ values[inside, axis])
            result[~inside, axis], _ = cg(matrix, right, x0=result[~inside, axis], rtol=TOLERANCE)
        return result.reshape(known.shape)

    def material(self, grid: Grid, mesh: VentricularMesh, positions: Floats, displacement: Floats) -> Floats:
        """Material points (k, j, i, 3) [m] of the voxels of images: exact in the wall, extended elsewhere."""
        places = voxel_centres(grid)
        index = np.moveaxis(self.grid.index(places), -1, 0)[::-1]
        shift = [
            map_coordinates(displacement[..., axis], index, order=1, mode="grid-constant")
            for axis in range(3)
        ]
        exact = material_points(grid, mesh, positions)
        return np.where(np.isnan(exact), places + np.stack(shift, axis=-1), exact)


def voxel_centres(grid: Grid) -> Floats:
    """Positions (k, j, i, 3) [m] of the voxels."""
    return grid.points(np.moveaxis(np.indices(grid.shape)[::-1], 0, -1).astype(float))


def material_points(grid: Grid, mesh: VentricularMesh, positions: Floats) -> Floats:
    """Material points (k, j, i, 3) [m] of the voxels in the wall, NaN outside; positions (n, 3) [m] of the nodes."""
    low, extent = mesh.points.min(axis=0), np.ptp(mesh.points, axis=0)
    shares, places = (mesh.points - low) / extent, grid.index(positions)
    coordinates = np.full((3, *grid.shape), np.nan)
    for image, ramp in zip(coordinates, RAMPS, strict=True):
        paint_wall(image, places, mesh.tets, shares, ramp, np.zeros((grid.size[2], 2)))
    points: Floats = low + np.moveaxis(coordinates, 0, -1) * extent
    return points


def register_warped(
    images: ImageSequence,
    mesh: VentricularMesh,
    motion: Motion,
    registration: FreeForm,
    features: Mapping[str, CurveFeatures],
) -> tuple[Motion, Comparison]:
    """Return the motion that registration recovers from such images, and its comparison with the simulated one.

    The registered mesh is the simulated one in the first frame.
    """
    start = mesh.with_points(motion.positions[0])
    registered = track(images, start, registration).motion
    return registered, compare_motions(start, motion, registered, features)

"""A mesh carried by registrations of pairs of images, each frame from where its neighbour's ended, as ours is."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
import SimpleITK as sitk
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.imaging.raster import wall_voxels
from heartfit.imaging.sampling import crop, resample_isotropic
from heartfit.imaging.sequence import Grid, ImageSequence

Mask = NDArray[np.bool_]

SURROUNDINGS = 8e-3
"""Margin of the images about the heart [m], as in our registration."""

REACH = 4e-3
"""Reach of the wall's neighbourhood [m], as in our registration."""


@dataclass(frozen=True, eq=False)
class Images:
    """Input of a matching, in voxels: end diastole, a frame, the voxels near the wall at end diastole, and the
    neighbour's transform, the identity at first."""

    fixed: sitk.Image
    moving: sitk.Image
    near: sitk.Image
    start: sitk.Transform


Matching = Callable[[Images], sitk.Transform]
"""Gives a transform from places of the fixed image to places of the moving one."""


def nothing(images: Images) -> sitk.Transform:
    """The matching that leaves the mesh where it is."""
    return images.start


def carried(sequence: ImageSequence, mesh: VentricularMesh, matching: Matching) -> Motion:
    """The mesh carried through a sequence."""
    sitk.ProcessObject.SetGlobalDefaultNumberOfThreads(1)
    cubes = resample_isotropic(crop(sequence, mesh.points, SURROUNDINGS))
    wall = wall_voxels(cubes.grid, mesh)
    voxels = cubes.voxels / np.percentile(cubes.voxels[0], 99.0)
    near = sitk.GetImageFromArray(_near(wall, cubes.grid).astype(np.uint8))
    frames = [sitk.GetImageFromArray(frame.astype(np.float32)) for frame in voxels]
    transforms = {0: sitk.Transform(3, sitk.sitkIdentity)}
    for frame, neighbour in _order(len(frames)):
        transforms[frame] = matching(Images(frames[0], frames[frame], near, transforms[neighbour]))
    index = cubes.grid.index(mesh.points).tolist()
    places = [[transforms[frame].TransformPoint(place) for place in index] for frame in range(len(frames))]
    return Motion(sequence.times, sequence.period, cubes.grid.points(np.array(places)))


def _near(what: Mask, grid: Grid) -> Mask:
    near: Mask = distance_transform_edt(~what) * grid.spacing[0] <= REACH
    return near


def _order(count: int) -> Iterator[tuple[int, int]]:
    """Frames after the first, each with its neighbour on the way from end diastole, forwards and backwards."""
    middle = count // 2
    yield from ((frame, frame - 1) for frame in range(1, middle + 1))
    yield from ((frame, (frame + 1) % count) for frame in range(count - 1, middle, -1))

"""The displacement that carries one image onto another: diffeomorphic demons, coarse to fine.

Each iteration moves every voxel along the gradient of brightness until fixed(x) = moving(x + u(x)), composes u with the
exponential of that update, so that it stays invertible, and smooths it (Vercauteren et al. 2009, NeuroImage 45:S61,
doi 10.1016/j.neuroimage.2008.10.040; the filter is SimpleITK's). Images have two or three dimensions.
"""

from dataclasses import dataclass

import numpy as np
import SimpleITK as sitk

from heartfit.geometry.arrays import Floats


@dataclass(frozen=True)
class Demons:
    """How two images are registered.

    smoothing: standard deviation of the Gaussian that smooths the displacement after every iteration, in voxels of the
    level; levels: by how much the images are shrunk and how many iterations follow, from coarse to fine; step: the
    longest update, likewise in voxels.
    """

    smoothing: float
    levels: tuple[tuple[int, int], ...] = ((4, 40), (2, 40), (1, 30))
    step: float = 2.0


def register(fixed: Floats, moving: Floats, method: Demons, start: Floats | None = None) -> Floats:
    """Displacement u (*shape, d) in voxels, components in the order i, j(, k), with fixed(x) = moving(x + u(x)).

    So u carries a place of the fixed image to where the moving image shows it. fixed, moving: arrays (k,) j, i of one
    shape, any unit of brightness; start (*shape, d): a first guess. The same input gives the same output to the bit.
    """
    target, source = (sitk.GetImageFromArray(image.astype(np.float32)) for image in (fixed, moving))
    begin = np.zeros((*fixed.shape, fixed.ndim)) if start is None else start
    field = sitk.GetImageFromArray(begin, isVector=True)
    for shrink, iterations in method.levels:
        coarse, moved = (sitk.BinShrink(image, [shrink] * fixed.ndim) for image in (target, source))
        field = _filter(method, iterations).Execute(coarse, moved, _on(coarse, field))
    found: Floats = sitk.GetArrayFromImage(_on(target, field))
    return found


def _filter(method: Demons, iterations: int) -> sitk.DiffeomorphicDemonsRegistrationFilter:
    demons = sitk.DiffeomorphicDemonsRegistrationFilter()
    demons.SetNumberOfThreads(1)  # jobs run side by side, and sums keep their order
    demons.SetNumberOfIterations(iterations)
    demons.SetSmoothDisplacementField(True)
    demons.SetStandardDeviations(method.smoothing)
    demons.SetMaximumUpdateStepLength(method.step)
    return demons


def _on(image: sitk.Image, field: sitk.Image) -> sitk.Image:
    """The field at the voxels of the image, beyond its own as at its nearest voxel."""
    return sitk.Resample(field, image, sitk.Transform(), sitk.sitkLinear, 0.0, sitk.sitkVectorFloat64, True)


def jacobian(displacement: Floats) -> Floats:
    """det(1 + du/dx) (*shape) of a displacement (*shape, d) in voxels, by central differences; <= 0 where it folds."""
    d = displacement.shape[-1]
    slopes = [np.gradient(displacement, axis=axis) for axis in reversed(range(d))]
    determinant: Floats = np.linalg.det(np.eye(d) + np.stack(slopes, axis=-1))
    return determinant

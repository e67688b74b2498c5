"""Registrations of SimpleITK: demons of two kinds, an affine map before them, and B-splines. Lengths are in voxels."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import SimpleITK as sitk

from benchmarks.registration.carried import Images, Matching

KINDS: dict[str, Callable[[], Any]] = {
    "diffeomorphic": sitk.DiffeomorphicDemonsRegistrationFilter,
    "fast symmetric": sitk.FastSymmetricForcesDemonsRegistrationFilter,
}
STEP, AT_REST = 2.0, 1e-4
"""Longest update of demons in an iteration, and the mean one at which they end."""

FLAT, SETTLED = 1e-9, 1e7
"""End of the search for B-splines: gradient, and decrease in units of the machine's precision. The gradient by one
control point is tiny: looser values end the search early, with V_min 25 % off."""


def demons(kind: str, levels: tuple[tuple[int, int], ...], smoothing: float, update: float = 0.0) -> Matching:
    """Demons, coarse to fine: shrinking and iterations of each level; displacement and update are smoothed."""

    def match(images: Images) -> sitk.Transform:
        transform = images.start
        for shrink, iterations in levels:
            fixed, moving = (sitk.BinShrink(image, [shrink] * 3) for image in (images.fixed, images.moving))
            field = KINDS[kind]()
            field.SetNumberOfIterations(iterations)
            field.SetStandardDeviations(smoothing)
            field.SetSmoothUpdateField(update > 0.0)
            field.SetUpdateFieldStandardDeviations(max(update, 1e-3))
            field.SetMaximumUpdateStepLength(STEP)
            field.SetMaximumRMSError(AT_REST)
            transform = sitk.DisplacementFieldTransform(field.Execute(fixed, moving, _on(fixed, transform)))
        return transform

    return match


def affine_first(then: Matching) -> Matching:
    """An affine map found near the wall, and another matching that begins with it instead of the neighbour's."""

    def match(images: Images) -> sitk.Transform:
        transform = sitk.AffineTransform(3)
        transform.SetCenter([0.5 * (size - 1) for size in images.fixed.GetSize()])
        search = _search(images, transform, (4, 2), near=True)
        search.SetOptimizerAsRegularStepGradientDescent(1.0, 0.01, 60)
        search.SetOptimizerScalesFromPhysicalShift()
        return then(replace(images, start=search.Execute(images.fixed, images.moving)))

    return match


def splines(knots: float, steps: int, share: float, near: bool = True, shrink: int = 2) -> Matching:
    """B-splines with control points so far apart, by mean squares over a share of all voxels or of those near."""

    def match(images: Images) -> sitk.Transform:
        if images.start.GetName() == "BSplineTransform":
            transform = sitk.BSplineTransform(images.start)
        else:
            cells = [max(1, round(size / knots)) for size in images.fixed.GetSize()]
            transform = sitk.BSplineTransformInitializer(images.fixed, cells, 3)
        search = _search(images, transform, (shrink,), near)
        search.SetMetricSamplingStrategy(search.RANDOM)
        search.SetMetricSamplingPercentage(share, seed=1)
        search.SetOptimizerAsLBFGSB(
            gradientConvergenceTolerance=FLAT, numberOfIterations=steps, costFunctionConvergenceFactor=SETTLED
        )
        search.Execute(images.fixed, images.moving)
        return transform

    return match


def _search(
    images: Images, transform: sitk.Transform, shrinks: tuple[int, ...], near: bool
) -> sitk.ImageRegistrationMethod:
    search = sitk.ImageRegistrationMethod()
    search.SetMetricAsMeanSquares()
    search.SetInterpolator(sitk.sitkLinear)
    search.SetShrinkFactorsPerLevel(shrinks)
    search.SetSmoothingSigmasPerLevel([0.5 * shrink for shrink in shrinks])
    search.SetInitialTransform(transform, inPlace=True)
    if near:
        search.SetMetricFixedMask(images.near)
    return search


def _on(image: sitk.Image, transform: sitk.Transform) -> sitk.Image:
    geometry = image.GetSize(), image.GetOrigin(), image.GetSpacing(), image.GetDirection()
    return sitk.TransformToDisplacementField(transform, sitk.sitkVectorFloat64, *geometry)

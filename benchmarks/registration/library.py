"""Registrations of SimpleITK: fast symmetric demons and B-splines. Lengths are in voxels."""

import SimpleITK as sitk

from benchmarks.registration.carried import Images, Matching

STEP, AT_REST = 2.0, 1e-4
"""Longest update of demons in an iteration, and the mean one at which they end."""

FLAT, SETTLED = 1e-9, 1e7
"""End of the search for B-splines: gradient, and decrease in units of the machine's precision. The gradient by one
control point is tiny: looser values end the search early, with V_min 25 % off."""


def demons(levels: tuple[tuple[int, int], ...], smoothing: float, update: float = 0.0) -> Matching:
    """Demons, coarse to fine: shrinking and iterations of each level; displacement and update are smoothed."""

    def match(images: Images) -> sitk.Transform:
        transform = images.start
        for shrink, iterations in levels:
            fixed, moving = (sitk.BinShrink(image, [shrink] * 3) for image in (images.fixed, images.moving))
            field = sitk.FastSymmetricForcesDemonsRegistrationFilter()
            field.SetNumberOfIterations(iterations)
            field.SetStandardDeviations(smoothing)
            field.SetSmoothUpdateField(update > 0.0)
            field.SetUpdateFieldStandardDeviations(max(update, 1e-3))
            field.SetMaximumUpdateStepLength(STEP)
            field.SetMaximumRMSError(AT_REST)
            transform = sitk.DisplacementFieldTransform(field.Execute(fixed, moving, _on(fixed, transform)))
        return transform

    return match


def splines(knots: float, steps: int, share: float, shrink: int = 2) -> Matching:
    """B-splines with control points so far apart, by mean squares over a share of the voxels near the wall."""

    def match(images: Images) -> sitk.Transform:
        if images.start.GetName() == "BSplineTransform":
            transform = sitk.BSplineTransform(images.start)
        else:
            cells = [max(1, round(size / knots)) for size in images.fixed.GetSize()]
            transform = sitk.BSplineTransformInitializer(images.fixed, cells, 3)
        search = sitk.ImageRegistrationMethod()
        search.SetMetricAsMeanSquares()
        search.SetMetricFixedMask(images.near)
        search.SetInterpolator(sitk.sitkLinear)
        search.SetShrinkFactorsPerLevel((shrink,))
        search.SetSmoothingSigmasPerLevel([0.5 * shrink])
        search.SetInitialTransform(transform, inPlace=True)
        search.SetMetricSamplingStrategy(search.RANDOM)
        search.SetMetricSamplingPercentage(share, seed=1)
        search.SetOptimizerAsLBFGSB(
            gradientConvergenceTolerance=FLAT, numberOfIterations=steps, costFunctionConvergenceFactor=SETTLED
        )
        search.Execute(images.fixed, images.moving)
        return transform

    return match


def _on(image: sitk.Image, transform: sitk.Transform) -> sitk.Image:
    geometry = image.GetSize(), image.GetOrigin(), image.GetSpacing(), image.GetDirection()
    return sitk.TransformToDisplacementField(transform, sitk.sitkVectorFloat64, *geometry)

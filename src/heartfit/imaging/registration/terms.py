"""Terms of the free-form registration: sums of squares over the coefficients of its lattice.

Each term gives its value and, linearised as in the Gauss-Newton method, its force (minus half the gradient), the
product of its curvature with a step, and an approximate diagonal of that curvature, which preconditions the linear
solver. All work in single precision, which halves the time.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Protocol

import numpy as np
from scipy.ndimage import gaussian_filter

from heartfit.core.arrays import Floats
from heartfit.imaging.raster import sample_fields
from heartfit.imaging.registration.lattice import Lattice


@dataclass(frozen=True, eq=False)
class PyramidLevel:
    """Level of an image pyramid: blocks of ``shrink`` voxels a side, and their positions along each axis."""

    shrink: int
    places: tuple[Floats, ...]

    @classmethod
    def from_shape(cls, shape: Sequence[int], shrink: int) -> "PyramidLevel":
        """Return the level for images of this shape; incomplete blocks at the far sides are left out."""
        return cls(shrink, tuple(shrink * np.arange(float(n // shrink)) + 0.5 * (shrink - 1) for n in shape))

    def reduce(self, image: Floats) -> Floats:
        """Smooth the image by half a block and average it over blocks, in single precision."""
        return self._blocks(gaussian_filter(image.astype(np.float32), 0.5 * self.shrink, mode="nearest"))

    def block_sums(self, weight: Floats) -> Floats:
        """Sum of a weight over each block."""
        sums: Floats = self._blocks(weight.astype(np.float32)) * self.shrink**weight.ndim
        return sums

    def index(self, places: Floats) -> Floats:
        """Indices at this level of positions in fine voxels."""
        index: Floats = (places - 0.5 * (self.shrink - 1)) / self.shrink
        return index

    def _blocks(self, image: Floats) -> Floats:
        for axis, places in enumerate(self.places):
            kept = np.take(image, np.arange(len(places) * self.shrink), axis)
            split = (*kept.shape[:axis], len(places), self.shrink, *kept.shape[axis + 1 :])
            image = kept.reshape(split).mean(axis=axis + 1)
        return image


@dataclass(frozen=True, eq=False)
class Linearised:
    """Value, force, curvature and its diagonal of a term at some coefficients."""

    value: float
    force: Floats
    curvature: Callable[[Floats], Floats]
    diagonal: Floats


class Term(Protocol):
    """Sum of squares over the coefficients of a lattice."""

    def linearise(self, coefficients: Floats) -> Linearised:
        """Linearise the term about these coefficients."""
        ...


def total(parts: Iterable[Floats]) -> Floats:
    """Sum of arrays of one shape, in their order."""
    return reduce(np.add, parts)


class Bending:
    """Bending energy s sum_x |D^2 u(x)|^2."""

    def __init__(self, lattice: Lattice, stiffness: float) -> None:
        self._lattice, self._stiffness = lattice, stiffness
        self._diagonal = stiffness * lattice.bending_diagonal

    def linearise(self, coefficients: Floats) -> Linearised:
        force = -self._curvature(coefficients)
        return Linearised(-float((coefficients * force).sum()), force, self._curvature, self._diagonal)

    def _curvature(self, step: Floats) -> Floats:
        return self._stiffness * self._lattice.bending(step)


class WallVolume:
    """Incompressibility q sum_x w(x) (J(x) - 1)^2 of the wall with J = det(1 + du/dx).

    Edges show the thickening of the wall and little of its shortening: this term derives the one from the other, as in
    Mansi T et al. 2011, doi 10.1007/s11263-010-0405-z.
    """

    def __init__(self, lattice: Lattice, level: PyramidLevel, wall: Floats, incompressibility: float) -> None:
        self._derivatives = [lattice.sampling(level.places, axis) for axis in range(wall.ndim)]
        self._weight = incompressibility * level.block_sums(wall)

    def linearise(self, coefficients: Floats) -> Linearised:
        gradient = np.stack([part.displacement(coefficients) for part in self._derivatives], axis=1)
        jacobian, cofactor = _determinant(
            gradient + np.eye(len(gradient), dtype=np.float32)[:, :, None, None, None]
        )
        rows = list(np.moveaxis(cofactor, 1, 0))

        def spread(swelling: Floats) -> Floats:
            weighted = self._weight * swelling
            return total(
                part.transposed(weighted * row) for part, row in zip(self._derivatives, rows, strict=True)
            )

        def curvature(step: Floats) -> Floats:
            return spread(
                total(
                    (row * part.displacement(step)).sum(axis=0)
                    for part, row in zip(self._derivatives, rows, strict=True)
                )
            )

        value = float((self._weight * (jacobian - 1.0) ** 2).sum())
        diagonal = total(
            part.diagonal(self._weight * row**2) for part, row in zip(self._derivatives, rows, strict=True)
        )
        return Linearised(value, spread(1.0 - jacobian), curvature, diagonal)


class FixedImage:
    """Image to which others are matched, at one level; ``weight``: of each voxel in the comparison."""

    def __init__(self, lattice: Lattice, level: PyramidLevel, image: Floats, weight: Floats) -> None:
        self.level, self.sampling = level, lattice.sampling(level.places)
        self.image, self.weight = level.reduce(image), level.block_sums(weight)
        self._places = np.stack(np.meshgrid(*level.places, indexing="ij")).astype(np.float32)

    def index(self, coefficients: Floats) -> Floats:
        """Indices of the displaced voxels in another image of this level."""
        return self.level.index(self._places + self.sampling.displacement(coefficients))


class Brightness:
    """Mismatch sum_x w(x) (F(x) - M(x + u(x)))^2 of the brightness of the fixed and the moving image."""

    def __init__(self, fixed: FixedImage, moving: Floats) -> None:
        image = fixed.level.reduce(moving)
        self._fixed, self._fields = fixed, np.stack([image, *np.gradient(image)])

    def mismatch(self, coefficients: Floats) -> float:
        """Root mean square difference of the images, by weight."""
        weight = self._fixed.weight
        residual = self._residual_and_slope(coefficients)[0]
        return float(np.sqrt((weight * residual**2).sum() / weight.sum()))

    def linearise(self, coefficients: Floats) -> Linearised:
        residual, slope = self._residual_and_slope(coefficients)
        weight, sampling = self._fixed.weight, self._fixed.sampling

        def curvature(step: Floats) -> Floats:
            along = (slope * sampling.displacement(step)).sum(axis=0)
            return sampling.transposed(weight * along * slope)

        return Linearised(
            float((weight * residual**2).sum()),
            sampling.transposed(weight * residual * slope),
            curvature,
            sampling.diagonal(weight * slope**2),
        )

    def _residual_and_slope(self, coefficients: Floats) -> tuple[Floats, Floats]:
        """Difference of brightness (...) and gradient (dimension, ...) of the moving image at the displaced voxels."""
        fixed = self._fixed
        displaced = sample_fields(self._fields, fixed.index(coefficients), fixed.weight)
        return fixed.image - displaced[0], displaced[1:] / fixed.level.shrink


def _determinant(matrix: Floats) -> tuple[Floats, Floats]:
    """Determinant (...) and cofactors (a, b, ...) of three-by-three matrices (a, b, ...)."""
    a, b, c = matrix
    cofactor = np.stack([_cross(b, c), _cross(c, a), _cross(a, b)])
    return (a * cofactor[0]).sum(axis=0), cofactor


def _cross(a: Floats, b: Floats) -> Floats:
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])

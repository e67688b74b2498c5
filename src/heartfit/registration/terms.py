"""What a displacement should do, as sums of squares over the coefficients of its lattice.

Each term gives its value and, linearised as Gauss and Newton do, its force (minus half the gradient), the product of
its curvature with a step, and roughly the diagonal of that curvature, which conditions the search for the step. All
work in single precision, which halves the time.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import reduce
from typing import Protocol

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.imaging.raster import sampled
from heartfit.registration.lattice import Lattice
from heartfit.registration.level import Level


@dataclass(frozen=True, eq=False)
class Linearised:
    """A term at some coefficients."""

    value: float
    force: Floats
    curvature: Callable[[Floats], Floats]
    diagonal: Floats


class Term(Protocol):
    """A sum of squares."""

    def at(self, coefficients: Floats) -> Linearised:
        """The term about these coefficients."""
        ...


def total(parts: Iterable[Floats]) -> Floats:
    """The sum of arrays of one shape, in their order."""
    return reduce(np.add, parts)


class Bending:
    """s sum_x |D^2 u(x)|^2: what bends little."""

    def __init__(self, lattice: Lattice, stiffness: float) -> None:
        self._lattice, self._stiffness = lattice, stiffness
        self._diagonal = stiffness * lattice.bending_diagonal

    def at(self, coefficients: Floats) -> Linearised:
        force = -self._curvature(coefficients)
        return Linearised(-float((coefficients * force).sum()), force, self._curvature, self._diagonal)

    def _curvature(self, step: Floats) -> Floats:
        return self._stiffness * self._lattice.bending(step)


class WallVolume:
    """q sum_x w(x) (J(x) - 1)^2 with J = det(1 + du/dx): muscle keeps its volume.

    Edges show how the wall thickens, and hardly anything how it shortens: this term tells the one from the other, as
    in Mansi T et al. 2011, doi 10.1007/s11263-010-0405-z.
    """

    def __init__(self, lattice: Lattice, level: Level, wall: Floats, incompressibility: float) -> None:
        self._derivatives = [lattice.on(level.places, axis) for axis in range(wall.ndim)]
        self._weight = incompressibility * level.total(wall)

    def at(self, coefficients: Floats) -> Linearised:
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
    """The image that others are matched to, at one level; ``weight`` says where they are compared."""

    def __init__(self, lattice: Lattice, level: Level, image: Floats, weight: Floats) -> None:
        self.level, self.sampling = level, lattice.on(level.places)
        self.image, self.weight = level.reduced(image), level.total(weight)
        self._places = np.stack(np.meshgrid(*level.places, indexing="ij")).astype(np.float32)

    def index(self, coefficients: Floats) -> Floats:
        """Where in another image of this level the displaced voxels lie."""
        return self.level.index(self._places + self.sampling.displacement(coefficients))


class Brightness:
    """sum_x w(x) (F(x) - M(x + u(x)))^2: a point keeps its brightness from the fixed to the moving image."""

    def __init__(self, fixed: FixedImage, moving: Floats) -> None:
        image = fixed.level.reduced(moving)
        self._fixed, self._fields = fixed, np.stack([image, *np.gradient(image)])

    def mismatch(self, coefficients: Floats) -> float:
        """Root mean square difference of the images where they are compared."""
        weight = self._fixed.weight
        residual = self._compared(coefficients)[0]
        return float(np.sqrt((weight * residual**2).sum() / weight.sum()))

    def at(self, coefficients: Floats) -> Linearised:
        residual, slope = self._compared(coefficients)
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

    def _compared(self, coefficients: Floats) -> tuple[Floats, Floats]:
        """Difference of brightness (...) and gradient (dimension, ...) of the moving image, where they are compared."""
        fixed = self._fixed
        moved = sampled(self._fields, fixed.index(coefficients), fixed.weight)
        return fixed.image - moved[0], moved[1:] / fixed.level.shrink


def _determinant(matrix: Floats) -> tuple[Floats, Floats]:
    """Determinant (...) and cofactors (a, b, ...) of three-by-three matrices (a, b, ...)."""
    a, b, c = matrix
    cofactor = np.stack([_cross(b, c), _cross(c, a), _cross(a, b)])
    return (a * cofactor[0]).sum(axis=0), cofactor


def _cross(a: Floats, b: Floats) -> Floats:
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])

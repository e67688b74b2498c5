"""Displacements by cubic B-splines on a lattice of control points (free-form deformation), in any dimension.

    u(x) = sum_c d_c prod_a B(x_a / h - c_a)

with control points h voxels apart. On a grid of voxels this is one small matrix an axis, and so are its transpose and
the bending energy; no large matrix is ever formed.

References
----------
Rueckert D et al. 1999, doi 10.1109/42.796284.
"""

from collections.abc import Sequence
from functools import cached_property
from itertools import combinations_with_replacement

import numpy as np
from scipy.interpolate import BSpline

from heartfit.geometry.arrays import Floats

DEGREE = 3


class Lattice:
    """Control points over a grid of ``shape`` voxels, ``knots`` voxels apart along each axis.

    Coefficients have the shape (dimension, *counts), displacements (dimension, *places); both in voxels.
    """

    def __init__(self, shape: Sequence[int], knots: float) -> None:
        self.shape = tuple(shape)
        self._splines = [_spline(int(np.ceil((n - 1) / knots)) + DEGREE, knots) for n in shape]

    def zeros(self) -> Floats:
        """The coefficients of no displacement."""
        return np.zeros((len(self.shape), *(spline.c.shape[0] for spline in self._splines)), np.float32)

    def at(self, coefficients: Floats, places: Floats) -> Floats:
        """Displacements (n, dimension) at scattered places (n, dimension)."""
        held = np.clip(places, 0, np.array(self.shape) - 1)
        first, *others = (spline(place) for spline, place in zip(self._splines, held.T, strict=True))
        result = np.tensordot(first, coefficients, (1, 1))
        for weights in others:
            result = np.einsum("nc,nvc...->nv...", weights, result)
        return result

    def on(self, places: Sequence[Floats], along: int | None = None) -> "Sampling":
        """The lattice at the products of places (p_a,) along each axis, or its derivative ``along`` one of them."""
        return Sampling(
            [
                spline(place, nu=int(axis == along)).astype(np.float32)
                for axis, (spline, place) in enumerate(zip(self._splines, places, strict=True))
            ]
        )

    def bending(self, coefficients: Floats) -> Floats:
        """Half the gradient by the coefficients of sum_x |D^2 u(x)|^2 over the voxels x."""
        return np.sum([product(term, coefficients) for term in self._bending_terms], axis=0)

    @cached_property
    def bending_diagonal(self) -> Floats:
        """Diagonal of the above, (1, *counts): the same for each component."""
        ones = np.ones((1, *self.zeros().shape[1:]), np.float32)
        terms = [product([np.diag(np.diag(matrix)) for matrix in term], ones) for term in self._bending_terms]
        return np.sum(terms, axis=0)

    @cached_property
    def _bending_terms(self) -> list[list[Floats]]:
        """For each second derivative, what acts along each axis; the mixed ones count twice."""
        axes = range(len(self.shape))
        terms = []
        for a, b in combinations_with_replacement(axes, 2):
            factors = [grams[(a, b).count(axis)] for axis, grams in enumerate(self._grams)]
            terms.append([factors[0] * np.float32(1.0 if a == b else 2.0), *factors[1:]])
        return terms

    @cached_property
    def _grams(self) -> list[list[Floats]]:
        """Of each axis and each order of derivative 0, 1, 2: products of the control points' weights, summed."""
        weights = [
            [spline(np.arange(n), nu=order) for order in range(3)]
            for spline, n in zip(self._splines, self.shape, strict=True)
        ]
        return [[(weight.T @ weight).astype(np.float32) for weight in orders] for orders in weights]


class Sampling:
    """A lattice at the voxels of one grid; matrices (p_a, c_a) of the weights along each axis."""

    def __init__(self, matrices: Sequence[Floats]) -> None:
        self._matrices = matrices

    def displacement(self, coefficients: Floats) -> Floats:
        """The displacement (dimension, *places) that coefficients make."""
        return product(self._matrices, coefficients)

    def transposed(self, field: Floats) -> Floats:
        """The transpose of the above: what a force (dimension, *places) is for the coefficients."""
        return product([matrix.T for matrix in self._matrices], field)

    def diagonal(self, squares: Floats) -> Floats:
        """Diagonal of transpose times squares times displacement."""
        return product([matrix.T**2 for matrix in self._matrices], squares)


def product(matrices: Sequence[Floats], array: Floats) -> Floats:
    """Applies a matrix to each axis of the array but the first.

    Each in turn takes the axis that is then the second, and its result becomes the last, so that none has to be moved.
    """
    for matrix in matrices:
        components, points, *others = array.shape
        lines = array.reshape(components, points, -1).swapaxes(1, 2)
        array = (lines @ matrix.T).reshape(components, *others, len(matrix))
    return array


def _spline(count: int, knots: float) -> BSpline:
    """All B-splines of an axis as one vector-valued spline."""
    return BSpline(knots * (np.arange(count + DEGREE + 1) - DEGREE), np.eye(count), DEGREE)

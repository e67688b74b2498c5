"""Displacements by cubic B-splines on a lattice of control points (free-form deformation), in any dimension.

    u(x) = sum_c d_c prod_a B(x_a / h - c_a)

with control points h voxels apart. On a grid of voxels this is one small matrix for each axis, and so are its transpose
and the bending energy; no large matrix is ever formed.

References
----------
Rueckert D et al. 1999, doi 10.1109/42.796284.
"""

from collections.abc import Sequence
from functools import cached_property
from itertools import combinations_with_replacement

import numpy as np
from scipy.interpolate import BSpline

from heartfit.core.arrays import Floats

DEGREE = 3
"""Degree of the B-splines."""


class Lattice:
    """Control points over a grid of ``shape`` voxels, ``knots`` voxels apart along each axis.

    Coefficients have the shape (dimension, *counts), displacements (dimension, *places); both in voxels.
    """

    def __init__(self, shape: Sequence[int], knots: float) -> None:
        self.shape = tuple(shape)
        self._splines = [_spline(int(np.ceil((n - 1) / knots)) + DEGREE, knots) for n in shape]

    def zeros(self) -> Floats:
        """Coefficients of zero displacement."""
        return np.zeros((len(self.shape), *(spline.c.shape[0] for spline in self._splines)), np.float32)

    def evaluate(self, coefficients: Floats, places: Floats) -> Floats:
        """Displacements (n, dimension) at scattered places (n, dimension)."""
        clipped = np.clip(places, 0, np.array(self.shape) - 1)
        first, *others = (spline(place) for spline, place in zip(self._splines, clipped.T, strict=True))
        result = np.tensordot(first, coefficients, (1, 1))
        for weights in others:
            result = np.einsum("nc,nvc...->nv...", weights, result)
        return result

    def sampling(self, places: Sequence[Floats], along: int | None = None) -> "Sampling":
        """Sample the lattice, or its derivative ``along`` an axis, on the product grid of places (p_a,)."""
        return Sampling(
            [
                spline(place, nu=int(axis == along)).astype(np.float32)
                for axis, (spline, place) in enumerate(zip(self._splines, places, strict=True))
            ]
        )

    def bending(self, coefficients: Floats) -> Floats:
        """Half the gradient with respect to the coefficients of sum_x |D^2 u(x)|^2 over the voxels x."""
        return np.sum([product(term, coefficients) for term in self._bending_terms], axis=0)

    @cached_property
    def bending_diagonal(self) -> Floats:
        """Diagonal (1, *counts) of the linear map `bending`: the same for each component."""
        ones = np.ones((1, *self.zeros().shape[1:]), np.float32)
        terms = [product([np.diag(np.diag(matrix)) for matrix in term], ones) for term in self._bending_terms]
        return np.sum(terms, axis=0)

    @cached_property
    def _bending_terms(self) -> list[list[Floats]]:
        """Matrices along each axis for each second derivative; the mixed ones count twice."""
        axes = range(len(self.shape))
        terms = []
        for a, b in combinations_with_replacement(axes, 2):
            factors = [grams[(a, b).count(axis)] for axis, grams in enumerate(self._grams)]
            terms.append([factors[0] * np.float32(1.0 if a == b else 2.0), *factors[1:]])
        return terms

    @cached_property
    def _grams(self) -> list[list[Floats]]:
        """Gram matrices of the weights of the control points, by axis and order of derivative 0, 1, 2."""
        weights = [
            [spline(np.arange(n), nu=order) for order in range(3)]
            for spline, n in zip(self._splines, self.shape, strict=True)
        ]
        return [[(weight.T @ weight).astype(np.float32) for weight in orders] for orders in weights]


class Sampling:
    """Lattice sampled at the voxels of one grid; matrices (p_a, c_a): weights along each axis."""

    def __init__(self, matrices: Sequence[Floats]) -> None:
        self._matrices = matrices

    def displacement(self, coefficients: Floats) -> Floats:
        """Displacement (dimension, *places) of coefficients (dimension, *counts)."""
        return product(self._matrices, coefficients)

    def transposed(self, field: Floats) -> Floats:
        """Transpose of `displacement`: from a force (dimension, *places) to one on the coefficients."""
        return product([matrix.T for matrix in self._matrices], field)

    def diagonal(self, squares: Floats) -> Floats:
        """Diagonal of transpose times diag(squares) times displacement."""
        return product([matrix.T**2 for matrix in self._matrices], squares)


def product(matrices: Sequence[Floats], array: Floats) -> Floats:
    """Apply one matrix to each axis of the array except the first.

    Each matrix acts on the present second axis and puts its result last, so no axis has to be transposed.
    """
    for matrix in matrices:
        components, points, *others = array.shape
        lines = array.reshape(components, points, -1).swapaxes(1, 2)
        array = (lines @ matrix.T).reshape(components, *others, len(matrix))
    return array


def _spline(count: int, knots: float) -> BSpline:
    """Return all B-splines of an axis as one vector-valued spline."""
    return BSpline(knots * (np.arange(count + DEGREE + 1) - DEGREE), np.eye(count), DEGREE)

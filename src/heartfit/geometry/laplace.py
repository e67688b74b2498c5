"""Harmonic fields on tetrahedra: P1 elements by scikit-fem, one factorisation for any number of fields."""

import numpy as np
from scipy.sparse.linalg import splu
from skfem import Basis, ElementTetP1, MeshTet
from skfem.models.poisson import laplace

from heartfit.geometry.arrays import Floats, Integers


def harmonic_extension(points: Floats, tets: Integers, fixed: Integers, values: Floats) -> Floats:
    """The field (n, ...) with div grad u = 0, u = values (f, ...) on the nodes `fixed` (f,), no flux."""
    stiffness = laplace.assemble(_basis(points, tets)).tocsr()
    free = np.setdiff1d(np.arange(len(points)), fixed)
    field = np.zeros((len(points), *values.shape[1:]))
    field[fixed] = values
    load = -stiffness[free][:, fixed] @ values.reshape(len(fixed), -1)
    field[free] = splu(stiffness[free][:, free].tocsc()).solve(load).reshape(len(free), *values.shape[1:])
    return field


def between(points: Floats, tets: Integers, one: Integers, zero: Integers) -> Floats:
    """The harmonic field (n,) that is 1 on the nodes `one` and 0 on the nodes `zero`; on shared ones, 1."""
    fixed = np.union1d(one, zero)
    return harmonic_extension(points, tets, fixed, np.isin(fixed, one).astype(float))


def element_gradients(points: Floats, tets: Integers, field: Floats) -> Floats:
    """Gradient (m,3) of a nodal field (n,) in each tetrahedron."""
    return np.asarray(_basis(points, tets).interpolate(field).grad)[:, :, 0].T


def _basis(points: Floats, tets: Integers) -> Basis:
    return Basis(
        MeshTet(np.ascontiguousarray(points.T), np.ascontiguousarray(tets.T)), ElementTetP1(), intorder=1
    )

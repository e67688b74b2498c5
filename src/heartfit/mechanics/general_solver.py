"""Factors of a tangent that is not symmetric, by SuperLU."""

import numpy as np
from scipy.sparse import coo_array, csc_array, diags_array
from scipy.sparse.linalg import splu

from heartfit.geometry.arrays import Floats, Integers


class GeneralFactor:
    """LU factors, in single precision and equilibrated, of the sum of element matrices and nodal blocks.

    ``elements`` (m, 4 d, 4 d) belong to the tetrahedra (m, 4), ``nodes`` (n, d, d) to their nodes; ``permutation``
    (n d,) is the order in which the unknowns are eliminated.
    """

    def __init__(self, tets: Integers, elements: Floats, nodes: Floats, permutation: Integers) -> None:
        matrix = _assemble(tets, elements, nodes)[permutation][:, permutation]
        self._permutation = permutation
        self._scale = 1.0 / np.sqrt(np.abs(matrix.diagonal()))
        scaling = diags_array(self._scale)
        single = csc_array(scaling @ matrix @ scaling, dtype=np.float32)
        self._factors = splu(single, permc_spec="NATURAL", diag_pivot_thresh=0.0)

    def solve(self, right: Floats) -> Floats:
        """Solution (N,)."""
        solution = np.empty_like(right)
        permuted = (right[self._permutation] * self._scale).astype(np.float32)
        solution[self._permutation] = self._factors.solve(permuted) * self._scale
        return solution


def _assemble(tets: Integers, elements: Floats, nodes: Floats) -> csc_array:
    n, d = nodes.shape[:2]
    unknowns = (d * tets[:, :, None] + np.arange(d)).reshape(len(tets), -1)
    blocks = d * np.arange(n)[:, None] + np.arange(d)
    rows = [np.repeat(each, each.shape[1], axis=1).ravel() for each in (unknowns, blocks)]
    columns = [np.tile(each, (1, each.shape[1])).ravel() for each in (unknowns, blocks)]
    values = np.concatenate([elements.ravel(), nodes.ravel()])
    places = (np.concatenate(rows), np.concatenate(columns))
    return csc_array(coo_array((values, places), shape=(n * d, n * d)).tocsc())

"""Sparse symmetric factorisation with a nested-dissection order of the nodes."""

import numpy as np
import pymetis
from scipy.sparse import coo_array, csc_array, diags_array
from scipy.sparse.linalg import SuperLU, splu

from heartfit.geometry.arrays import Floats, Integers


def nested_dissection(tets: Integers, nodes: int) -> Integers:
    """Elimination order (n,) of the nodes that METIS finds on the mesh's graph."""
    first, second = np.repeat(tets, 4, axis=1).ravel(), np.tile(tets, (1, 4)).ravel()
    apart = first != second
    pairs = (first[apart], second[apart])
    graph = coo_array((np.ones(apart.sum(), dtype=np.int8), pairs), shape=(nodes, nodes)).tocsr()
    adjacency = pymetis.CSRAdjacency(adj_starts=graph.indptr, adjacent=graph.indices)
    order, _ = pymetis.nested_dissection(adjacency)
    return np.asarray(order, dtype=np.int64)


class Factor:
    """LU factors of a symmetric, possibly indefinite matrix, equilibrated by its diagonal."""

    def __init__(self, matrix: csc_array, permutation: Integers) -> None:
        self._permutation = permutation
        self._scale = 1.0 / np.sqrt(np.abs(matrix.diagonal()))
        scaling = diags_array(self._scale)
        self._factors = _factorise(scaling @ matrix @ scaling)

    def solve(self, right: Floats) -> Floats:
        """Solution (N,) or (N, k) in the unpermuted numbering."""
        scale = self._scale if right.ndim == 1 else self._scale[:, None]
        solution = np.empty_like(right)
        permuted = (right[self._permutation] * scale).astype(np.float32)
        solution[self._permutation] = self._factors.solve(permuted) * scale
        return solution


def _factorise(matrix: csc_array) -> SuperLU:
    """Factors in single precision: Newton needs a direction, and triangular solves are bound by memory."""
    single = csc_array(matrix.astype(np.float32))
    return splu(single, permc_spec="NATURAL", diag_pivot_thresh=0.0, options={"SymmetricMode": True})

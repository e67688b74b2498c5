"""Multifrontal factorisation of the tangent.

A front holds the dense blocks :math:`F_{11}` of its own unknowns, :math:`F_{12}`, :math:`F_{21}` and :math:`F_{22}` of
the rows it touches. Its elimination keeps :math:`S = F_{11}^{-1}`, :math:`G = F_{21} S` and :math:`H = (S F_{12})^T`,
which is G where the matrix is symmetric, and leaves :math:`F_{22} - G F_{12}` to its parent; a solution needs one
product with G in the forward sweep, and one with H and one with S in the backward sweep. The dense algebra is in single
precision, which suffices for the direction of a Newton step. The tangent of the forces is symmetric but indefinite:
LAPACK pivots within a front; no pivoting takes place between fronts, since the matrix of the mixed element is
quasi-definite. Source: Duff and Reid, ACM Trans. Math. Softw. 9 (1983) 302.
"""

from typing import Any

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats, Integers
from heartfit.heart.finite_elements.elimination import find_fronts
from heartfit.heart.finite_elements.kinematics import StepFailed

UPDATE_BLOCK = 96
"""Number of rows of an update computed at a time, up to their diagonal block; the rest of its upper triangle is not."""

Singles = np.ndarray[tuple[int, ...], np.dtype[np.float32]]


class Elimination:
    """Symbolic factorisation for one mesh, with ``dofs`` unknowns per node."""

    def __init__(self, tets: Integers, nodes: int, dofs: int) -> None:
        f = self._fronts = find_fronts(tets, nodes)
        self.dofs = dofs
        self.permutation = (dofs * f.order[:, None] + np.arange(dofs)).ravel()
        position = np.empty(nodes, dtype=np.int64)
        position[f.order] = np.arange(nodes)
        self._tets = position[tets]
        home = np.repeat(np.arange(len(f.parents)), np.diff(f.starts))[self._tets.min(axis=1)]
        self._elements = np.argsort(home, kind="stable")
        self._element_starts = np.searchsorted(home[self._elements], np.arange(len(f.parents) + 1))
        own, touched = dofs * np.diff(f.starts), dofs * np.diff(f.row_starts)
        self._inverse_starts = np.concatenate([[0], np.cumsum(own * own)])
        self._coupling_starts = np.concatenate([[0], np.cumsum(own * touched)])
        self._stack = _stack_size(touched, f.parents)

    @property
    def shape(self) -> tuple[Any, ...]:
        """Index arrays of the substitutions: fronts, their rows, and the places of their blocks."""
        f = self._fronts
        return f.starts, f.rows, f.row_starts, self._inverse_starts, self._coupling_starts

    def factorise(self, elements: Floats, nodes: Floats, symmetric: bool = True) -> "Factor":
        """Factorise the sum of element matrices (m, 4 dofs, 4 dofs) and nodal blocks (n, dofs, dofs).

        Raises StepFailed if the sum is singular to single precision or not finite.
        """
        inverses = np.empty(self._inverse_starts[-1], dtype=np.float32)
        couplings = np.empty(self._coupling_starts[-1], dtype=np.float32)
        transposed = couplings if symmetric else np.empty_like(couplings)
        f, matrix = self._fronts, (elements, nodes[self._fronts.order])
        arguments = (
            *matrix,
            self._tets,
            self._elements,
            self._element_starts,
            *self.shape,
            f.parents,
            self._stack,
        )
        try:
            _eliminate(*arguments, symmetric, inverses, couplings, transposed)  # type: ignore[call-arg]
        except (np.linalg.LinAlgError, ZeroDivisionError) as failure:
            raise StepFailed(f"the tangent cannot be factorised: {failure}") from failure
        return Factor(self, inverses, couplings, transposed)


class Factor:
    """Factors of a matrix, as computed by :meth:`Elimination.factorise`."""

    def __init__(
        self, elimination: Elimination, inverses: Singles, couplings: Singles, transposed: Singles
    ) -> None:
        self._elimination, self._blocks = elimination, (inverses, couplings, transposed)

    def solve(self, right: Floats) -> Floats:
        """Solution (N,) or (N, k), in the numbering of the mesh; not finite where single precision overflows."""
        permutation = self._elimination.permutation
        solution = np.empty_like(right)
        with np.errstate(over="ignore"):
            y = right[permutation].astype(np.float32)
        arguments = (y, self._elimination.dofs, *self._elimination.shape, *self._blocks)
        if y.ndim == 1:
            _substitute(*arguments)
        else:
            _substitute_columns(*arguments)
        solution[permutation] = y
        return solution


@njit(cache=True)
def _stack_size(touched: Integers, parents: Integers) -> int:
    """Largest total number of entries of the updates that wait for their parents."""
    waiting, largest = 0, 0
    released = np.zeros(len(parents), dtype=np.int64)
    for s in range(len(parents)):
        waiting += touched[s] ** 2 - released[s]
        if parents[s] >= 0:
            released[parents[s]] += touched[s] ** 2
        largest = max(largest, waiting)
    return largest


@njit(cache=True)
def _eliminate(  # type: ignore[no-untyped-def]
    elements, nodes, tets, chosen, chosen_starts,
    starts, rows, row_starts, inverse_starts, coupling_starts, parents, stack_size,
    symmetric, inverses, couplings, transposed,
):  # fmt: skip
    """Fill ``inverses``, ``couplings`` and ``transposed`` with S, G and H of every front.

    ``chosen`` lists the elements by front. The last two are one array for a ``symmetric`` matrix.
    """
    dofs = nodes.shape[1]
    place, corners = np.empty(len(nodes), dtype=np.int64), np.empty(4, dtype=np.int64)
    stack, filled = np.empty(stack_size, dtype=np.float32), 0
    waiting, top = np.empty(len(parents), dtype=np.int64), 0
    largest = (np.diff(starts) + np.diff(row_starts)).max()
    work = np.empty((dofs * largest) ** 2, dtype=np.float32)
    for s in range(len(parents)):
        touched = rows[row_starts[s] : row_starts[s + 1]]
        c, r = dofs * (starts[s + 1] - starts[s]), dofs * len(touched)
        _set_places(place, starts[s], starts[s + 1], touched, dofs)
        front = work[: (c + r) ** 2].reshape(c + r, c + r)
        front[:] = 0.0
        for i in range(starts[s], starts[s + 1]):
            _extend_add(front, nodes[i], place[i : i + 1], dofs, symmetric)
        for e in chosen[chosen_starts[s] : chosen_starts[s + 1]]:
            for a in range(4):
                corners[a] = place[tets[e, a]]
            _extend_add(front, elements[e], corners, dofs, symmetric)
        while top > 0 and parents[waiting[top - 1]] == s:
            top -= 1
            left = rows[row_starts[waiting[top]] : row_starts[waiting[top] + 1]]
            size = dofs * len(left)
            filled -= size * size
            update = stack[filled : filled + size * size].reshape(size, size)
            _extend_add(front, update, place[left], dofs, symmetric)
        inverse = _inverse(front[:c, :c], symmetric)
        _fill(inverses[inverse_starts[s] : inverse_starts[s + 1]].reshape(c, c), inverse)
        if r:
            below = front[c:, :c].copy()
            coupling = couplings[coupling_starts[s] : coupling_starts[s + 1]].reshape(r, c)
            update = stack[filled : filled + r * r].reshape(r, r)
            np.dot(below, inverse, coupling)
            if symmetric:
                _schur_complement(front[c:, c:], coupling, below, update)
            else:
                beside = front[:c, c:].copy()
                back = transposed[coupling_starts[s] : coupling_starts[s + 1]].reshape(r, c)
                _fill(back, np.dot(inverse, beside).T)
                _fill(update, front[c:, c:] - np.dot(coupling, beside))
            filled += r * r
            waiting[top] = s
            top += 1


@njit(cache=True)
def _set_places(place, start, end, touched, dofs):  # type: ignore[no-untyped-def]
    """Set the columns of a front's own nodes, from ``start`` to ``end``, and of those that it touches."""
    for i in range(start, end):
        place[i] = dofs * (i - start)
    for i in range(len(touched)):
        place[touched[i]] = dofs * (end - start + i)


@njit(cache=True)
def _extend_add(front, block, places, dofs, symmetric):  # type: ignore[no-untyped-def]
    """Add a ``block``, whose nodes have the columns ``places``, to ``front``; only lower triangles if ``symmetric``.

    The upper triangle of a symmetric block is read where ``places`` do not ascend.
    """
    n = dofs * len(places)
    columns = np.empty(n, dtype=np.int64)
    for i in range(len(places)):
        for k in range(dofs):
            columns[dofs * i + k] = places[i] + k
    ascend = True
    for i in range(len(places) - 1):
        ascend = ascend and places[i] < places[i + 1]
    for i in range(n):
        row, source = columns[i], block[i]
        target = front[row]
        for j in range(i + 1 if symmetric and ascend else n):
            if columns[j] <= row or not symmetric:
                target[columns[j]] += source[j]


@njit(cache=True)
def _schur_complement(rest, coupling, below, update):  # type: ignore[no-untyped-def]
    """Fill the lower triangle of ``update`` with the Schur complement F22 - G F21^T of the eliminated block."""
    block = UPDATE_BLOCK if len(rest) > 2 * UPDATE_BLOCK else len(rest)
    for start in range(0, len(rest), block):
        end = min(start + block, len(rest))
        _fill(update[start:end, :end], rest[start:end, :end] - np.dot(coupling[start:end], below[:end].T))


@njit(cache=True)
def _fill(target, values):  # type: ignore[no-untyped-def]
    """Copy a matrix to ``target`` of its shape; numba takes seconds to compile an assignment to a slice."""
    for i in range(target.shape[0]):
        for j in range(target.shape[1]):
            target[i, j] = values[i, j]


@njit(cache=True)
def _inverse(block, symmetric):  # type: ignore[no-untyped-def]
    """Inverse of a ``block``, of which a symmetric one holds its lower triangle, equilibrated for LAPACK."""
    n = len(block)
    scale, full = np.empty(n, dtype=np.float32), np.empty((n, n), dtype=np.float32)
    for i in range(n):
        scale[i] = 1.0 / np.sqrt(abs(block[i, i]))
        for j in range(i + 1):
            full[i, j] = block[i, j] * scale[i] * scale[j]
            full[j, i] = full[i, j] if symmetric else block[j, i] * scale[i] * scale[j]
    result = np.linalg.inv(full)
    for i in range(n):
        for j in range(n):
            result[i, j] *= scale[i] * scale[j]
    return result


@njit(cache=True)
def _substitute(  # type: ignore[no-untyped-def]
    y, dofs, starts, rows, row_starts, inverse_starts, coupling_starts, inverses, couplings, transposed,
):  # fmt: skip
    """Solve in place for ``y`` (N,), in the order of elimination: forward sweep, then backward sweep."""
    k = len(starts) - 1
    largest = dofs * max(np.diff(starts).max(), np.diff(row_starts).max())
    own, change, outer = np.empty(largest, y.dtype), np.empty(largest, y.dtype), np.empty(largest, y.dtype)
    for s in range(k):
        touched = rows[row_starts[s] : row_starts[s + 1]]
        a, c, r = dofs * starts[s], dofs * (starts[s + 1] - starts[s]), dofs * len(touched)
        if r:
            coupling = couplings[coupling_starts[s] : coupling_starts[s + 1]].reshape(r, c)
            np.dot(coupling, y[a : a + c], outer[:r])
            for i in range(len(touched)):
                for m in range(dofs):
                    y[dofs * touched[i] + m] -= outer[dofs * i + m]
    for s in range(k - 1, -1, -1):
        touched = rows[row_starts[s] : row_starts[s + 1]]
        a, c, r = dofs * starts[s], dofs * (starts[s + 1] - starts[s]), dofs * len(touched)
        inverse = inverses[inverse_starts[s] : inverse_starts[s + 1]].reshape(c, c)
        np.dot(inverse, y[a : a + c], own[:c])
        if r:
            back = transposed[coupling_starts[s] : coupling_starts[s + 1]].reshape(r, c)
            for i in range(len(touched)):
                for m in range(dofs):
                    outer[dofs * i + m] = y[dofs * touched[i] + m]
            np.dot(outer[:r], back, change[:c])
            for i in range(c):
                own[i] -= change[i]
        for i in range(c):
            y[a + i] = own[i]


@njit(cache=True)
def _substitute_columns(  # type: ignore[no-untyped-def]
    y, dofs, starts, rows, row_starts, inverse_starts, coupling_starts, inverses, couplings, transposed,
):  # fmt: skip
    """Solve in place for the columns of ``y`` (N, k): products of matrices load each factor once for all of them."""
    fronts, columns = len(starts) - 1, y.shape[1]
    for s in range(fronts):
        touched = rows[row_starts[s] : row_starts[s + 1]]
        a, c, r = dofs * starts[s], dofs * (starts[s + 1] - starts[s]), dofs * len(touched)
        if r:
            coupling = couplings[coupling_starts[s] : coupling_starts[s + 1]].reshape(r, c)
            down = np.dot(coupling, y[a : a + c])
            for i in range(len(touched)):
                own, place = dofs * i, dofs * touched[i]
                rest = y[place : place + dofs]
                _fill(rest, rest - down[own : own + dofs])
    for s in range(fronts - 1, -1, -1):
        touched = rows[row_starts[s] : row_starts[s + 1]]
        a, c, r = dofs * starts[s], dofs * (starts[s + 1] - starts[s]), dofs * len(touched)
        inverse = inverses[inverse_starts[s] : inverse_starts[s + 1]].reshape(c, c)
        x = np.dot(inverse, y[a : a + c])
        if r:
            back = transposed[coupling_starts[s] : coupling_starts[s + 1]].reshape(r, c)
            gathered = np.empty((r, columns), dtype=np.float32)
            for i in range(len(touched)):
                own, place = dofs * i, dofs * touched[i]
                _fill(gathered[own : own + dofs], y[place : place + dofs])
            x -= np.dot(back.T, gathered)
        _fill(y[a : a + c], x)

"""Minimises a sum of squares over the coefficients of a lattice by Gauss and Newton's steps.

Conjugate gradients solve each step's linear system without a matrix: a product is a displacement of the lattice and
its transpose.
"""

from collections.abc import Sequence

import numpy as np
from scipy.sparse.linalg import LinearOperator, cg

from heartfit.geometry.arrays import Floats
from heartfit.registration.terms import Linearised, Term, total

INNER_STEPS, INNER_TOLERANCE = 10, 1e-2
SETTLED = 2e-3
"""Relative decrease of the sum at which the iteration ends."""
SHORTEST = 0.1
"""Share of a step below which none is found that goes down."""


def minimise(terms: Sequence[Term], start: Floats, steps: int) -> Floats:
    """The coefficients after at most so many steps, each halved until the sum goes down."""
    coefficients, here = start, [term.at(start) for term in terms]
    for _ in range(steps):
        before, step, share = _value(here), _gauss_newton(here), 1.0
        there = [term.at(coefficients + step) for term in terms]
        while _value(there) > before and share > SHORTEST:
            share *= 0.5
            there = [term.at(coefficients + share * step) for term in terms]
        if _value(there) > before:
            break
        coefficients, here = coefficients + share * step, there
        if _value(here) > (1.0 - SETTLED) * before:
            break
    return coefficients


def _value(terms: Sequence[Linearised]) -> float:
    return sum(term.value for term in terms)


def _gauss_newton(terms: Sequence[Linearised]) -> Floats:
    """The step (shape of the coefficients) to the minimum of the linearised terms."""
    force, diagonal = total(term.force for term in terms), total(term.diagonal for term in terms)
    shape, size = force.shape, force.size
    # a knot that no voxel sees has no force: whatever divides it, it stays
    weights = np.where(diagonal > 0.0, diagonal, 1.0).ravel()

    def curvature(flat: Floats) -> Floats:
        step = flat.reshape(shape)
        return total(term.curvature(step) for term in terms).ravel()

    system = LinearOperator((size, size), matvec=curvature, dtype=np.float32)
    scale = LinearOperator((size, size), matvec=lambda flat: flat / weights, dtype=np.float32)
    flat, _ = cg(system, force.ravel(), rtol=INNER_TOLERANCE, maxiter=INNER_STEPS, M=scale)
    step: Floats = flat.reshape(shape).astype(np.float32)
    return step

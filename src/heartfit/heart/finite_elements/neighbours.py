"""States of a wall, carried to a neighbouring wall of another stress-free reference."""

from dataclasses import replace

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.finite_elements import kinematics
from heartfit.heart.finite_elements.body import BodyState, FiniteElementBody


def carry_state(state: BodyState, body: FiniteElementBody, other: FiniteElementBody) -> BodyState:
    """State of the ``other`` body with the nodes where they are in a ``state`` of ``body``.

    Its strains differ by the change of the reference, and the contractile strains with them, so that no series element
    is stretched by the exchange.
    """
    if other.reference is body.reference:
        return state
    offset = body.reference.points - other.reference.points
    x, C = _carry(state.x, offset, other)
    x_before, C_before = _carry(state.x_before, offset, other)
    fibres = state.fibres.copy()
    fibres[0] += kinematics.fibre_strain(C, other.dyads) - kinematics.fibre_strain(state.C, body.dyads)
    return replace(state, x=x, C=C, x_before=x_before, C_before=C_before, fibres=fibres)


def _carry(x: Floats, offset: Floats, other: FiniteElementBody) -> tuple[Floats, Floats]:
    """Unknowns (n, dofs) and C (m, 6) of the other body at the same positions."""
    x = x.copy()
    x[:, :3] += offset
    m = len(other.tets)
    F, C, J = np.empty((m, 3, 3)), np.empty((m, 6)), np.empty(m)
    kinematics.deformation_gradient(x, other.tets, other.gradients, F)
    kinematics.right_cauchy_green(F, C, J)
    return x, C

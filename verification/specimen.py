"""The ventricles on which whole beats are verified: a parametric shape, no measured data needed."""

from functools import cache

import numpy as np

from heartfit.geometry.fibres import prepare
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.mesher import fill_wall
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.heart.activation.conduction import assign_activation

SHAPE = ParametricVentricles(
    edv=130e-6, wall_thickness=10e-3, sphericity=0.95, rv_edv=140e-6, rv_wall_thickness=4.5e-3
)
END_DIASTOLIC_PRESSURE = np.array([1300.0, 520.0])
"""Pressures of the left and the right ventricle [Pa], as in the study."""

USUAL, COARSE = (0.015, 0.6e-3), (0.017, 1.2e-3)
"""Edge length and tolerance, m, of some 3000 and 1600 tetrahedra."""


@cache
def specimen(size: tuple[float, float] = USUAL) -> VentricularMesh:
    """The ventricles at end diastole, with fibres and activation."""
    return assign_activation(prepare(fill_wall(SHAPE.surface(), *size)))

"""An elasticity of the wall."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.places.place import FunctionOfState
from heartfit.roles import Stress


@dataclass(frozen=True)
class WallElasticity(FunctionOfState, Stress):
    r"""Derivative of the energy of the wall [Pa] by the invariant :math:`x = \bar I_1 - 3`, free up to x = RANGE.

    .. math:: W'(x) = x f(x / x_{max}) ,

    so that the reference stays free of stress. It acts while the wall contracts, too.
    """

    region = "wall"
    slot = "the elasticity of the wall"
    unit = "Pa"
    amplitude = 6000.0
    acts_on = "wall"
    RANGE = 1.2

    def slopes(self, x: Floats) -> tuple[Floats, Floats]:
        u = np.asarray(x) / self.RANGE
        value = self.function.at(u)
        return x * value, value + u * self.function.slope_at(u)

r"""A pressure on the outside of a ventricle as data: pressure and slope from four coefficients.

.. math:: p(\bar V) = p_0 + a\, e^{(\bar V - V_0) / v}

with :math:`\bar V` the mean volume of the ventricles that beat side by side, which for one alone is its own. A wall
that keeps its volume hands the pressure outside on to its cavity as it is. One function serves ventricles of elements,
in Python, and compiled spheres.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from heartfit.geometry.arrays import Floats


class Load(NamedTuple):
    """``pulse`` p_0 and ``rise`` a, Pa, ``volume`` V_0 and ``scale`` v, m^3; numbers, or arrays over times."""

    pulse: float | Floats = 0.0
    rise: float | Floats = 0.0
    volume: float | Floats = 0.0
    scale: float | Floats = 1.0


@njit(cache=True, error_model="numpy", inline="always")
def outside(loads, t, v, mean):  # type: ignore[no-untyped-def]
    """Sum of the ``loads`` (.., k, v, 4) of ventricle v at time t, Pa, and its derivative by the mean volume, m^3."""
    pressure, slope = 0.0, 0.0
    for k in range(loads.shape[1]):
        rise, scale = loads[t, k, v, 1], loads[t, k, v, 3]
        if rise != 0.0:
            rise *= np.exp((mean - loads[t, k, v, 2]) / scale)
        pressure += loads[t, k, v, 0] + rise
        slope += rise / scale
    return pressure, slope

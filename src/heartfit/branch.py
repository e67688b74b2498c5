r"""The law of a branch of the circuit as data: flow and slope from four coefficients.

.. math:: q(\Delta p) = K \Delta p + A \sqrt{2/\rho}\, \Delta p\, (\Delta p^2 + \epsilon^2)^{-1/4},

a conductance K beside an orifice of area A, each with one value for forward (:math:`\Delta p > 0`) and one for
backward flow. The orifice is Bernoulli's, its root smoothed over :math:`\epsilon` = 20 Pa. Valves and leaks are such
branches, so one function serves them all, in Python and in compiled beats.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from heartfit.geometry.arrays import Floats

BLOOD_DENSITY = 1060.0
"""kg/m^3"""

SMOOTHING = 20.0
"""Pressure drop, Pa, below which the orifice law is linear: the square root has no slope at zero."""


class Branch(NamedTuple):
    """Coefficients of a branch: conductances, m^3/(s Pa), and orifice areas, m^2, forward and backward.

    Each is a number, or an array over times.
    """

    conductance: float | Floats = 0.0
    area: float | Floats = 0.0
    back_conductance: float | Floats = 0.0
    back_area: float | Floats = 0.0

    def flow(self, drop: float) -> tuple[float, float]:
        """Flow, m^3/s, at the pressure drop, Pa, and its derivative by the drop."""
        flow, slope = branch_flow(np.array(self), drop)
        return float(flow), float(slope)


@njit(cache=True, error_model="numpy")
def branch_flow(law, drop):  # type: ignore[no-untyped-def]
    """Flow and slope of the law (4,); increases with the drop."""
    conductance, area = (law[0], law[1]) if drop > 0.0 else (law[2], law[3])
    flow, slope = conductance * drop, conductance
    if area != 0.0:
        factor = area * np.sqrt(2.0 / BLOOD_DENSITY)
        smooth = drop * drop + SMOOTHING * SMOOTHING
        root = factor / np.sqrt(np.sqrt(smooth))
        flow += root * drop
        slope += root * (0.5 * drop * drop + SMOOTHING * SMOOTHING) / smooth
    return flow, slope

r"""Law of an atrium with a volume, and of the veins that fill it.

With the volume V of the atrium, the volume :math:`V_v` of the ventricle whose valve plane descends into it, and the
contraction e(t),

.. math:: P = P_w(x) + e(t) E_{act} (x - V_0) + P_{out}, \qquad x = V + \kappa (V_v - V_{ref}), \qquad
          P_w = \begin{cases} E_0 V_s \big(e^{(x - V_0)/V_s} - 1\big) & x > V_0 \\ E_0 (x - V_0) & x \le V_0
          \end{cases}

The tangent continues the passive law below :math:`V_0`, so that every pressure has one volume. Blood enters from
veins of pressure :math:`P_v` and elastance :math:`E_v`, which the arteries of the other circuit fill:

.. math:: q_v = \frac{P_v - P}{R_v}, \qquad \dot P_v = E_v \Big(\frac{P_c - P_v}{R_p} - q_v\Big).

With :math:`E_v = 0` the veins are a reservoir of constant pressure, open to the outside.
"""

from typing import NamedTuple

import numpy as np
from numba import njit


class Atrium(NamedTuple):
    """Coefficients of the law: volumes [m^3], elastances [Pa/m^3], resistance [Pa s/m^3], pressure [Pa].

    ``unstressed`` V_0, ``passive`` E_0, ``scale`` V_s, ``active`` E_act, ``descent`` kappa, ``ventricle`` V_ref;
    ``resistance`` R_v, ``reservoir`` P_v at the start, ``veins`` E_v.
    """

    unstressed: float
    passive: float
    scale: float
    active: float
    descent: float
    ventricle: float
    resistance: float
    reservoir: float
    veins: float


UNSTRESSED, PASSIVE, SCALE, ACTIVE, DESCENT, VENTRICLE, RESISTANCE, RESERVOIR, VEINS = range(9)
"""Rows of the table of atria, which begins with the coefficients; a prescribed atrium has the resistance 0."""

START_VOLUME, START_VEIN, STIFFENING, OUTSIDE = range(9, 13)
"""Rows of a step: starting values of V and P_v; e(t) E_act and P_out at its end."""

VEIN, VEIN_PER_INFLOW, VEIN_PER_PRESSURE = range(13, 16)
"""Rows of the vein at the end of a step, P_v = first + second times the inflow of its arteries + third times P."""

TREE, TREE_PER_INFLOW, TREE_PER_PRESSURE = range(16, 19)
"""Rows of the arteries that fill the veins: P_ar = first + second times their inflow + third times P."""

BALANCE = 19
"""Row of the constant of the volume balance [m^3], without the descent of the valve plane."""

VOLUME, PRESSURE, VEIN_END = range(20, 23)
"""Rows of the results at the end of a step: V, P and P_v."""

ATRIUM_ROWS = 23


@njit(cache=True, error_model="numpy")
def wall_pressure(atria, s, x):  # type: ignore[no-untyped-def]
    """Pressure of atrium s at the stretched volume x [m^3], without an outside pressure, and its derivative."""
    stretch, slope = x - atria[UNSTRESSED, s], atria[PASSIVE, s]
    pressure = slope * stretch
    if stretch > 0.0:
        growth = stretch / atria[SCALE, s]
        pressure, slope = slope * atria[SCALE, s] * np.expm1(growth), slope * np.exp(growth)
    return pressure + atria[STIFFENING, s] * stretch, slope + atria[STIFFENING, s]


INVERSE_TOLERANCE, MAX_ITERATIONS = 1e-14, 60
"""Relative change of a volume at which the law is inverted, and largest number of iterations."""


@njit(cache=True, error_model="numpy")
def stretched_volume(atria, s, pressure):  # type: ignore[no-untyped-def]
    """Inverse of :func:`wall_pressure`: x [m^3] and its derivative by the pressure, by Newton's method from above.

    The law is convex, and both its passive and its linear part bound x from above, so the iteration is monotone.
    """
    E_0, V_s, active = atria[PASSIVE, s], atria[SCALE, s], atria[STIFFENING, s]
    stretch = pressure / (E_0 + active)
    if pressure > 0.0:
        stretch = min(stretch, V_s * np.log1p(pressure / (E_0 * V_s)))
        for _ in range(MAX_ITERATIONS):
            excess = E_0 * V_s * np.expm1(stretch / V_s) + active * stretch - pressure
            change = excess / (E_0 * np.exp(stretch / V_s) + active)
            stretch -= change
            if abs(change) <= INVERSE_TOLERANCE * stretch:
                break
    x = atria[UNSTRESSED, s] + stretch
    return x, 1.0 / wall_pressure(atria, s, x)[1]

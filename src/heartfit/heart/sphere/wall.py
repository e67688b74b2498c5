r"""Wall of one spherical ventricle: cavity pressure as a function of the stretch, with its slope.

The equations are those of :mod:`heartfit.heart.sphere.body`, with inertia,

.. math:: P = \frac{\Omega}{V'(\Lambda)} \Big[ \frac{dW}{d\Lambda} + \eta \dot E : \frac{\partial E}{\partial\Lambda}
          + \Lambda\, \overline{\sigma_{1D}} + \rho R_0^2 \ddot\Lambda \Big].

The pressure is an explicit function of the stretch, which is therefore the only unknown of the mechanics. Rates are
those of :mod:`heartfit.heart.time_step`.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats
from heartfit.heart.muscle.fibre_equation import fibre_response
from heartfit.heart.muscle.passive import Passive, require_isotropic
from heartfit.heart.sphere import rows
from heartfit.heart.sphere.body import LARGEST_STRETCH, SMALLEST_STRETCH

TABLE_INTERVALS = 512
TABLE_SPACING = (LARGEST_STRETCH - SMALLEST_STRETCH) / TABLE_INTERVALS


class CompiledStep(NamedTuple):
    """Step of :mod:`heartfit.heart.time_step`; starting values are now + ``gain`` (now - before)."""

    length: float
    second_order: bool
    memory: float
    effective: float
    gain: float


@lru_cache(maxsize=64)
def tabulate(law: Passive, scale: float = 1.0) -> Floats:
    """Table (2, k) of stress, and of stiffness times TABLE_SPACING, of an isotropic law for cubic interpolation.

    ``scale`` multiplies the moduli of the law.
    The relative error of the interpolated stress of the standard tissue is 1e-8. A law may be infinite near the bounds;
    a step that reaches them fails. Tables are cached, since many hearts of a search share a law.
    """
    passive = require_isotropic(law)
    stretch: Floats = np.linspace(SMALLEST_STRETCH, LARGEST_STRETCH, TABLE_INTERVALS + 1)
    with np.errstate(over="ignore", invalid="ignore"):
        return np.array(
            [
                passive.in_plane_stress(stretch, scale),
                TABLE_SPACING * passive.in_plane_stiffness(stretch, scale),
            ]
        )


@njit(cache=True, error_model="numpy", inline="always")
def passive_stress(tables, v, stretch):  # type: ignore[no-untyped-def]
    """In-plane stress and stiffness [Pa] of side v, by cubic Hermite interpolation in the ``tables`` (2 v, k)."""
    place = (stretch - SMALLEST_STRETCH) / TABLE_SPACING
    i = min(int(place), TABLE_INTERVALS - 1)
    t = place - i
    stress, stiffness = 2 * v, 2 * v + 1
    left, right = tables[stress, i], tables[stress, i + 1]
    rise, fall = tables[stiffness, i], tables[stiffness, i + 1]
    a, b = rise + fall - 2.0 * (right - left), 3.0 * (right - left) - 2.0 * rise - fall
    return left + t * (rise + t * (b + t * a)), (rise + t * (2.0 * b + 3.0 * t * a)) / TABLE_SPACING


@njit(cache=True, error_model="numpy", inline="always")
def cavity(radius, ratio, stretch):  # type: ignore[no-untyped-def]
    """Volume of the cavity [m^3] and its first and second derivatives by the stretch."""
    per = 1.0 / stretch
    thick = ratio * per * per
    inner, slope, bend = stretch - thick, 1.0 + 2.0 * thick * per, -6.0 * thick * per * per
    scale = 4.0 * np.pi * radius * radius * radius
    volume = scale / 3.0 * inner * inner * inner
    return volume, scale * inner * inner * slope, scale * inner * (2.0 * slope * slope + inner * bend)


@njit(cache=True, error_model="numpy", inline="always")
def viscous_stress(stretch, plane, radial):  # type: ignore[no-untyped-def]
    r""":math:`\Delta E : \partial E/\partial\Lambda` and its derivative by the stretch.

    The strain :math:`\Delta E` counts from the squared stretches ``plane`` and ``radial``.
    """
    square = stretch * stretch
    thin = 1.0 / (square * square)
    across, through = square - plane, thin - radial
    stress = across * stretch - through * thin / stretch
    slope = across + 2.0 * square + (5.0 * through + 4.0 * thin) * thin / square
    return stress, slope


@njit(cache=True, error_model="numpy", inline="always")
def fibre_tension(active, step, sides, fibres, v):  # type: ignore[no-untyped-def]
    """Mean fibre stress [Pa] of side v at the end of the step, and its derivative by the strain."""
    old, stretch = sides[rows.NOW + rows.STRETCH, v], sides[rows.X, v]
    e_old, e_new = 0.5 * (old * old - 1.0), 0.5 * (stretch * stretch - 1.0)
    move = e_new - 0.5 * (sides[rows.X_BEFORE, v] ** 2 - 1.0)
    count = fibres.shape[1] // sides.shape[1]
    total, slope = 0.0, 0.0
    for i in range(v * count, (v + 1) * count):
        rate, attach, n_0 = fibres[rows.U, i], fibres[rows.U_PLUS, i], fibres[rows.N_0, i]
        guess = fibres[rows.INCREMENT, i] + fibres[rows.INCREMENT_SLOPE, i] * move
        e_c, k, lam = fibres[rows.E_C, i], fibres[rows.K_C, i], fibres[rows.LAMBDA, i]
        stress, stiffness, increment, increment_slope = fibre_response(
            rate, attach, n_0, step.length, step.second_order, active, e_old, e_new, e_c, k, lam, guess
        )
        fibres[rows.SIGMA, i], fibres[rows.SLOPE, i] = stress, stiffness
        fibres[rows.INCREMENT, i], fibres[rows.INCREMENT_SLOPE, i] = increment, increment_slope
        total += stress
        slope += stiffness
    sides[rows.X_BEFORE, v], ahead = stretch, (1.0 + step.memory) / count
    return ahead * total - step.memory * sides[rows.STRESS, v], ahead * slope


@njit(cache=True, error_model="numpy", inline="always")
def cavity_pressure(passive, active, eta, density, step, sides, fibres, v):  # type: ignore[no-untyped-def]
    """Pressure [Pa] of cavity v at its trial stretch, its volume [m^3], both with their derivatives by the stretch."""
    stretch, rate = sides[rows.X, v], 1.0 / step.effective
    stress, slope = passive_stress(passive, v, stretch)
    drag, bend = viscous_stress(stretch, sides[rows.START_PLANE, v], sides[rows.START_RADIAL, v])
    contraction, stiff = fibre_tension(active, step, sides, fibres, v)
    mass = density * sides[rows.RADIUS, v] ** 2
    acceleration = rate * (
        rate * (stretch - sides[rows.START + rows.STRETCH, v]) - sides[rows.START + rows.SPEED, v]
    )
    stress += eta * rate * drag + stretch * contraction + mass * acceleration
    slope += eta * rate * bend + contraction + stretch * stretch * stiff + mass * rate * rate
    volume, area, curve = cavity(sides[rows.RADIUS, v], sides[rows.RATIO, v], stretch)
    per = sides[rows.WALL, v] / area
    return per * stress, per * (slope - stress * curve / area), volume, area

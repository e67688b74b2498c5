r"""The wall of one spherical ventricle: the cavity pressure that it holds at a stretch, and its slope.

The equations are those of :mod:`heartfit.mechanics.sphere`, with inertia,

.. math:: P = \frac{\Omega}{V'(\Lambda)} \Big[ \frac{dW}{d\Lambda} + \eta \dot E : \frac{\partial E}{\partial\Lambda}
          + \Lambda\, \overline{\sigma_{1D}} + \rho R_0^2 \ddot\Lambda \Big].

At given stretch the pressure follows without a solve, so the stretch is the only unknown of the mechanics.
Rates are those of :mod:`heartfit.mechanics.time_step`.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numba import njit

from heartfit.geometry.arrays import Floats
from heartfit.mechanics.active.bcs import fibre_response
from heartfit.mechanics.passive.law import Passive, isotropic
from heartfit.mechanics.sphere import LARGEST_STRETCH, SMALLEST_STRETCH
from heartfit.sphere import rows as at

INTERVALS = 512
SPACING = (LARGEST_STRETCH - SMALLEST_STRETCH) / INTERVALS


class Step(NamedTuple):
    """A step as in :mod:`heartfit.mechanics.time_step`: starting values are now + ``gain`` (now - before)."""

    length: float
    second_order: bool
    memory: float
    effective: float
    gain: float


@lru_cache(maxsize=64)
def tabulated(law: Passive) -> Floats:
    """Stress and stiffness (2, k) of any isotropic law at equal steps of stretch, for cubic interpolation.

    Between them the stress of the standard tissue is right to 1e-8 of itself. Towards the bounds a law may be
    infinite: the step that gets there fails. Many hearts of a search have the same law, so tables are kept.
    """
    passive = isotropic(law)
    stretch: Floats = np.linspace(SMALLEST_STRETCH, LARGEST_STRETCH, INTERVALS + 1)
    with np.errstate(over="ignore", invalid="ignore"):
        return np.array([passive.in_plane_stress(stretch), SPACING * passive.in_plane_stiffness(stretch)])


@njit(cache=True, error_model="numpy", inline="always")
def passive_stress(table, stretch):  # type: ignore[no-untyped-def]
    """In-plane stress and stiffness, Pa, by Hermite's cubic."""
    place = (stretch - SMALLEST_STRETCH) / SPACING
    i = min(int(place), INTERVALS - 1)
    t = place - i
    left, right, rise, fall = table[0, i], table[0, i + 1], table[1, i], table[1, i + 1]
    a, b = rise + fall - 2.0 * (right - left), 3.0 * (right - left) - 2.0 * rise - fall
    return left + t * (rise + t * (b + t * a)), (rise + t * (2.0 * b + 3.0 * t * a)) / SPACING


@njit(cache=True, error_model="numpy", inline="always")
def cavity(radius, ratio, stretch):  # type: ignore[no-untyped-def]
    """Volume of the cavity, m^3, with its first and second derivative by the stretch."""
    per = 1.0 / stretch
    thick = ratio * per * per
    inner, slope, bend = stretch - thick, 1.0 + 2.0 * thick * per, -6.0 * thick * per * per
    scale = 4.0 * np.pi * radius * radius * radius
    volume = scale / 3.0 * inner * inner * inner
    return volume, scale * inner * inner * slope, scale * inner * (2.0 * slope * slope + inner * bend)


@njit(cache=True, error_model="numpy", inline="always")
def viscous(stretch, plane, radial):  # type: ignore[no-untyped-def]
    r""":math:`\Delta E : \partial E/\partial\Lambda` since the squares ``plane``, ``radial``, and its derivative."""
    square = stretch * stretch
    thin = 1.0 / (square * square)
    across, through = square - plane, thin - radial
    stress = across * stretch - through * thin / stretch
    slope = across + 2.0 * square + (5.0 * through + 4.0 * thin) * thin / square
    return stress, slope


@njit(cache=True, error_model="numpy", inline="always")
def tension(active, step, sides, fibres, v):  # type: ignore[no-untyped-def]
    """Mean fibre stress of side v at the end of the step and its derivative by the strain."""
    old, stretch = sides[at.NOW + at.STRETCH, v], sides[at.X, v]
    e_old, e_new = 0.5 * (old * old - 1.0), 0.5 * (stretch * stretch - 1.0)
    move = e_new - 0.5 * (sides[at.X_BEFORE, v] ** 2 - 1.0)
    count = fibres.shape[1] // sides.shape[1]
    total, slope = 0.0, 0.0
    for i in range(v * count, (v + 1) * count):
        drive = fibres[at.U, i], fibres[at.U_PLUS, i], fibres[at.N_0, i], step.length, step.second_order
        guess = fibres[at.INCREMENT, i] + fibres[at.TURN, i] * move
        held = fibres[at.E_C, i], fibres[at.K_C, i], fibres[at.LAMBDA, i], guess
        stress, stiffness, increment, turn = fibre_response(*drive, active, e_old, e_new, *held)
        fibres[at.SIGMA, i], fibres[at.SLOPE, i] = stress, stiffness
        fibres[at.INCREMENT, i], fibres[at.TURN, i] = increment, turn
        total += stress
        slope += stiffness
    sides[at.X_BEFORE, v], ahead = stretch, (1.0 + step.memory) / count
    return ahead * total - step.memory * sides[at.STRESS, v], ahead * slope


@njit(cache=True, error_model="numpy", inline="always")
def cavity_pressure(passive, active, eta, density, step, sides, fibres, v):  # type: ignore[no-untyped-def]
    """Pressure of cavity v at its trial stretch, Pa, and its derivative by the stretch; volume and its derivative."""
    stretch, rate = sides[at.X, v], 1.0 / step.effective
    stress, slope = passive_stress(passive, stretch)
    drag, bend = viscous(stretch, sides[at.START_PLANE, v], sides[at.START_RADIAL, v])
    contraction, stiff = tension(active, step, sides, fibres, v)
    mass = density * sides[at.RADIUS, v] ** 2
    acceleration = rate * (rate * (stretch - sides[at.START + at.STRETCH, v]) - sides[at.START + at.SPEED, v])
    stress += eta * rate * drag + stretch * contraction + mass * acceleration
    slope += eta * rate * bend + contraction + stretch * stretch * stiff + mass * rate * rate
    volume, area, curve = cavity(sides[at.RADIUS, v], sides[at.RATIO, v], stretch)
    per = sides[at.WALL, v] / area
    return per * stress, per * (slope - stress * curve / area), volume, area

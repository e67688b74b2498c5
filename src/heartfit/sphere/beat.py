"""A compiled run of steps of one or two spherical ventricles."""

from typing import NamedTuple

import numpy as np
from numba import njit

from heartfit.circulation.circuit import ABOUT, GAP, ONE_MILLILITRE, STORED, WEIGHT, solve_circuit
from heartfit.geometry.arrays import Floats, Integers
from heartfit.load import outside
from heartfit.mechanics.sphere import LARGEST_STRETCH, SMALLEST_STRETCH
from heartfit.sphere import rows as at
from heartfit.sphere import step as steps
from heartfit.sphere.wall import cavity, cavity_pressure

TOLERANCE, ITERATIONS = 1e-3, 25
"""Imbalance, mL and kPa, after which one more Newton step, without a look at what it leaves, ends the iteration:
Newton's method squares it, and 1e-3 becomes some 1e-9."""


class Tissue(NamedTuple):
    """The wall of all sides: table of the passive law, constants of the sarcomere and its length dependence."""

    passive: Floats
    active: Floats
    starling: Floats
    eta: float
    density: float


class Course(NamedTuple):
    """What is prescribed in n steps of equal ``length``, s, with m fibres and k branches.

    Means over the steps of the control's size ``rate`` and positive part ``attach`` (n, m), 1/s; at their ends the
    pressures ``atria`` (n, v) of the atria and ``waves`` (n, v) in the arteries, Pa, the ``loads`` (n, l, v, 4) of v
    sides and the ``laws`` (n, k, 5) of the branches, whose ends are ``ends`` (k, 2).
    """

    length: float
    second_order: bool
    rate: Floats
    attach: Floats
    atria: Floats
    waves: Floats
    loads: Floats
    laws: Floats
    ends: Integers


class State(NamedTuple):
    """State at one time: tables of v sides, m fibres, k branches, and the lengths ``last`` (2,) of the last steps."""

    sides: Floats
    fibres: Floats
    branches: Floats
    last: Floats


@njit(cache=True, error_model="numpy", inline="always")
def respond(passive, active, eta, density, step, sides, fibres, p):  # type: ignore[no-untyped-def]
    """Outcome of deforming the walls to their trial stretches: the pressures p that they hold, and their response."""
    for v in range(sides.shape[1]):
        if not SMALLEST_STRETCH < sides[at.X, v] < LARGEST_STRETCH:
            return at.OVERSTRETCHED
        p[v], stiffness, volume, area = cavity_pressure(passive, active, eta, density, step, sides, fibres, v)
        if not abs(stiffness) > 0.0:
            return at.SOFT
        sides[at.STIFFNESS, v], sides[at.VOLUME, v], sides[at.COMPLIANCE, v] = (
            stiffness,
            volume,
            area / stiffness,
        )
    return at.DONE


@njit(cache=True, error_model="numpy", inline="always")
def press(loads, n, sides, p):  # type: ignore[no-untyped-def]
    """Add what lies outside to the pressures; how much stiffer against a common pressure the loads make the walls."""
    count, mean, stiffer = sides.shape[1], 0.0, 1.0
    for v in range(count):
        mean += sides[at.VOLUME, v] / count
    for v in range(count):
        pressure, sides[at.LOADING, v] = outside(loads, n, v, mean)
        p[v] += pressure
        stiffer += sides[at.LOADING, v] * sides[at.COMPLIANCE, v] / count
    return stiffer


@njit(cache=True, error_model="numpy", inline="always")
def linearise(step, stiffer, sides, system, p):  # type: ignore[no-untyped-def]
    """Response of the volumes to the pressures of the cavities, the loads giving way to all that swells."""
    count = sides.shape[1]
    for v in range(count):
        sides[at.P, v] = p[v]
        system[v, GAP], system[v, ABOUT] = (
            (sides[at.VOLUME, v] - sides[at.START_VOLUME, v]) / ONE_MILLILITRE,
            p[v],
        )
        system[v, WEIGHT] = step.effective / ONE_MILLILITRE
        for w in range(count):
            crowded = sides[at.LOADING, v] * sides[at.COMPLIANCE, w] / (stiffer * count)
            system[v, STORED + w] = sides[at.COMPLIANCE, v] * ((v == w) - crowded) / ONE_MILLILITRE


@njit(cache=True, error_model="numpy", inline="always")
def move(stiffer, sides, p):  # type: ignore[no-untyped-def]
    """Move the stretches to where the walls, so linearised, and their loads hold the pressures."""
    count, swelling = sides.shape[1], 0.0
    for v in range(count):
        swelling += sides[at.COMPLIANCE, v] * (p[v] - sides[at.P, v]) / (stiffer * count)
    for v in range(count):
        across = p[v] - sides[at.P, v] - sides[at.LOADING, v] * swelling
        sides[at.X, v] += across / sides[at.STIFFNESS, v]


@njit(cache=True, error_model="numpy", inline="always")
def record(sides, branches, curves, n):  # type: ignore[no-untyped-def]
    """Fill row n of the curves."""
    count = sides.shape[1]
    for v in range(count):
        curves[n, v] = cavity(sides[at.RADIUS, v], sides[at.RATIO, v], sides[at.NOW + at.STRETCH, v])[0]
        curves[n, count + v], curves[n, 2 * count + v] = sides[at.P, v], sides[at.NOW + at.ARTERY, v]
    for k in range(branches.shape[1]):
        curves[n, 3 * count + k] = branches[at.FLOW, k]


@njit(cache=True, error_model="numpy", _nrt=False)  # type: ignore[call-overload]
def _advance(tissue, course, state, curves, first, working):  # type: ignore[no-untyped-def]
    """:func:`advance` in given arrays. Without memory of its own it counts no references, which took half its time."""
    passive, active, starling, eta, density = tissue
    length, second_order, rate, attach, atria, waves, loads, laws, ends = course
    sides, fibres, branches, last = state
    moving, p, system, room, jacobian = working
    total = 0
    record(sides, branches, curves, first)
    for n in range(first, rate.shape[0]):
        step = steps.time_step(length, second_order, last[0])
        steps.begin_sides(step, sides)
        steps.begin_branches(step, branches)
        steps.begin_arteries(step, waves, n, sides, system)
        steps.begin_fibres(active, starling, step, rate, attach, n, sides, fibres)
        steps.predict(step, last, sides, p)
        outcome = at.UNSOLVED
        for _ in range(ITERATIONS):
            total += 1
            outcome = respond(passive, active, eta, density, step, sides, fibres, p)
            if outcome != at.DONE:
                break
            stiffer = press(loads, n, sides, p)
            linearise(step, stiffer, sides, system, p)
            size = solve_circuit(ends, laws, moving, atria, n, system, p, room, jacobian)
            move(stiffer, sides, p)
            if size < TOLERANCE:
                steps.follow(sides, fibres)
                break
            outcome = at.UNSOLVED
        if outcome == at.DONE and steps.torn(fibres):
            outcome = at.TORN
        if outcome != at.DONE:
            return n, outcome, total
        steps.commit_sides(step, waves, n, sides, p)
        steps.commit_branches(branches)
        steps.commit_fibres(active, step, sides, fibres)
        last[1], last[0] = last[0], length
        record(sides, branches, curves, n + 1)
    return rate.shape[0], at.DONE, total


@njit(cache=True, error_model="numpy")
def advance(tissue, course, state, curves, first):  # type: ignore[no-untyped-def]
    """Take the steps from ``first`` on; index of the first that failed, its outcome and the iterations of all.

    Row 0 of ``curves`` (n + 1, 3 v + k) is filled with volumes, pressures of ventricles and arteries, and flows at the
    start, the others with those after each step. A step that fails leaves the state as it was at its start.
    """
    n = 2 * state.sides.shape[1]
    equations = np.empty(n), np.zeros((n, 3 + n)), np.empty((3, n)), np.empty((n, n))
    return _advance(tissue, course, state, curves, first, (state.branches[at.PER_STEP :], *equations))

"""Compiled sequence of time steps of one or two spherical ventricles, by Newton's method in the stretches."""

from typing import NamedTuple

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats, Integers
from heartfit.heart.circulation.atria import begin_atria, descend_planes
from heartfit.heart.circulation.circuit import solve_circuit
from heartfit.heart.circulation.system import CONSTANT, ONE_MILLILITRE, REFERENCE, STORAGE, WEIGHT
from heartfit.heart.sphere import guess, rows
from heartfit.heart.sphere import step as steps
from heartfit.heart.sphere.body import LARGEST_STRETCH, SMALLEST_STRETCH
from heartfit.heart.sphere.wall import cavity, cavity_pressure
from heartfit.roles.chamber import PRESSURE, VOLUME
from heartfit.roles.laws import outside_pressure

IMBALANCE_TOLERANCE, NEWTON_ITERATIONS = 1e-3, 25
"""Imbalance [mL, kPa] below which one more Newton step, without another evaluation, ends the iteration, and the largest
number of iterations: Newton's method converges quadratically, so that 1e-3 becomes about 1e-9."""


class SphereTissue(NamedTuple):
    """Tissue of all sides: tables (2 v, k) of the passive laws, constants of sarcomere and length dependence.

    ``eta`` is the viscosity [Pa.s], ``density`` that of the wall [kg/m^3].
    """

    passive: Floats
    active: Floats
    starling: Floats
    eta: float
    density: float


class StepInputs(NamedTuple):
    """Prescribed inputs of n steps of equal ``length`` [s], for v sides, m fibres and k branches.

    Means over the steps: ``rate`` |u| and ``attach`` |u|_+ (n, m) [1/s]. Values at their ends: pressures ``atria`` (n,
    v) and ``waves`` (n, v) in the arteries [Pa], coefficients ``loads`` (n, l, v, 4) and ``laws`` (n, k, 6) of the
    branches, which connect the compartments ``ends`` (k, 2). Atria with a volume take the active elastances and
    pressures ``walls`` (n, 2, v) [Pa/m^3], [Pa] instead.
    """

    length: float
    second_order: bool
    rate: Floats
    attach: Floats
    atria: Floats
    walls: Floats
    waves: Floats
    loads: Floats
    laws: Floats
    ends: Integers


class State(NamedTuple):
    """State at one time: tables of sides, fibres and branches, and the lengths ``last`` (2,) of the last steps [s].

    ``chambers`` is the table of atria, see :mod:`heartfit.roles.chamber`, and ``reservoirs`` (4, v) are their volumes
    and the pressures of their veins, now and one step before; None if no atrium has a volume.
    """

    sides: Floats
    fibres: Floats
    branches: Floats
    last: Floats
    chambers: Floats | None
    reservoirs: Floats | None


@njit(cache=True, error_model="numpy", inline="always")
def respond_walls(passive, active, eta, density, step, sides, fibres, p):  # type: ignore[no-untyped-def]
    """Fill the pressures p and the responses of the walls at their trial stretches; return the outcome."""
    for v in range(sides.shape[1]):
        if not SMALLEST_STRETCH < sides[rows.X, v] < LARGEST_STRETCH:
            return rows.OVERSTRETCHED
        p[v], stiffness, volume, area = cavity_pressure(passive, active, eta, density, step, sides, fibres, v)
        if not abs(stiffness) > 0.0:
            return rows.NO_STIFFNESS
        sides[rows.STIFFNESS, v], sides[rows.VOLUME, v], sides[rows.COMPLIANCE, v] = (
            stiffness,
            volume,
            area / stiffness,
        )
    return rows.SOLVED


@njit(cache=True, error_model="numpy", inline="always")
def press_walls(loads, n, sides, p):  # type: ignore[no-untyped-def]
    """Add the outside pressures to p; return the factor by which the loads stiffen the walls to a common pressure."""
    count, mean, stiffer = sides.shape[1], 0.0, 1.0
    for v in range(count):
        mean += sides[rows.VOLUME, v] / count
    for v in range(count):
        pressure, sides[rows.LOADING, v] = outside_pressure(loads, n, v, mean)
        p[v] += pressure
        stiffer += sides[rows.LOADING, v] * sides[rows.COMPLIANCE, v] / count
    return stiffer


@njit(cache=True, error_model="numpy", inline="always")
def linearise_walls(step, stiffer, sides, system, p):  # type: ignore[no-untyped-def]
    """Fill the equations of the ventricles: linear response of the volumes to the cavity pressures, loads included."""
    count = sides.shape[1]
    for v in range(count):
        sides[rows.P, v] = p[v]
        system[v, CONSTANT], system[v, REFERENCE] = (
            (sides[rows.VOLUME, v] - sides[rows.START_VOLUME, v]) / ONE_MILLILITRE,
            p[v],
        )
        system[v, WEIGHT] = step.effective / ONE_MILLILITRE
        for w in range(count):
            crowded = sides[rows.LOADING, v] * sides[rows.COMPLIANCE, w] / (stiffer * count)
            system[v, STORAGE + w] = sides[rows.COMPLIANCE, v] * ((v == w) - crowded) / ONE_MILLILITRE


@njit(cache=True, error_model="numpy", inline="always")
def move_walls(stiffer, sides, p):  # type: ignore[no-untyped-def]
    """Move the stretches to the balance of the linearised walls and their loads with the pressures p."""
    count, swelling = sides.shape[1], 0.0
    for v in range(count):
        swelling += sides[rows.COMPLIANCE, v] * (p[v] - sides[rows.P, v]) / (stiffer * count)
    for v in range(count):
        across = p[v] - sides[rows.P, v] - sides[rows.LOADING, v] * swelling
        sides[rows.X, v] += across / sides[rows.STIFFNESS, v]


@njit(cache=True, error_model="numpy", inline="always")
def record_curves(sides, fibres, branches, chambers, curves, n, changes):  # type: ignore[no-untyped-def]
    """Fill row n of the curves, and store by how much the unknowns of a step differ from the beat before."""
    count, width = sides.shape[1], curves.shape[1]
    first = 3 * count + branches.shape[1]
    if chambers is not None:
        for v in range(count):
            curves[n, first + v] = chambers[VOLUME, v]
            guess.store(curves, n, first + count + v, changes, 2 * count + v, chambers[PRESSURE, v])
    for v in range(count):
        stretch = sides[rows.NOW + rows.STRETCH, v]
        curves[n, v] = cavity(sides[rows.RADIUS, v], sides[rows.RATIO, v], stretch)[0]
        curves[n, count + v] = sides[rows.P, v]
        guess.store(curves, n, 2 * count + v, changes, count + v, sides[rows.NOW + rows.ARTERY, v])
        guess.store(curves, n, width - count + v, changes, v, stretch)
    for k in range(branches.shape[1]):
        curves[n, 3 * count + k] = branches[rows.FLOW, k]
    own = changes.shape[1] - fibres.shape[1]
    increments = width - count - fibres.shape[1]
    for i in range(fibres.shape[1]):
        guess.store(curves, n, increments + i, changes, own + i, fibres[rows.INCREMENT, i])


@njit(cache=True, error_model="numpy", _nrt=False)  # type: ignore[call-overload]
def _advance(tissue, inputs, state, chambers, reservoirs, curves, first, workspace):  # type: ignore[no-untyped-def]
    """:func:`advance` in a preallocated ``workspace``: reference counts of local arrays would take half its time."""
    passive, active, starling, eta, density = tissue
    length, second_order, rate, attach, atria, walls, waves, loads, laws, ends = inputs
    sides, fibres, branches, last = state
    branch_states, p, system, work, jacobian, changes = workspace
    total = 0
    record_curves(sides, fibres, branches, chambers, curves, first, changes)
    guess.keep_changes(changes)
    for n in range(first, rate.shape[0]):
        step = steps.next_step(length, second_order, last[0])
        steps.begin_sides(step, sides)
        steps.begin_branches(step, branches)
        if chambers is not None:
            steps.begin_chambers(step, walls, n, chambers, reservoirs)
        steps.begin_arteries(step, waves, n, sides, chambers, system)
        if chambers is not None:
            begin_atria(chambers, step.effective, atria, n, system)
        steps.begin_fibres(active, starling, step, rate, attach, n, sides, fibres)
        guess.predict(step, last, curves, n + 1, changes, sides, fibres, chambers, p)
        outcome = rows.UNBALANCED
        for _ in range(NEWTON_ITERATIONS):
            total += 1
            outcome = respond_walls(passive, active, eta, density, step, sides, fibres, p)
            if outcome != rows.SOLVED:
                break
            stiffer = press_walls(loads, n, sides, p)
            linearise_walls(step, stiffer, sides, system, p)
            if chambers is not None:
                for v in range(chambers.shape[1]):
                    descend_planes(chambers, v, sides[rows.VOLUME, v], system)
            size = solve_circuit(ends, laws, branch_states, chambers, atria, n, system, p, work, jacobian)
            move_walls(stiffer, sides, p)
            if size < IMBALANCE_TOLERANCE:
                steps.follow_walls(sides, fibres)
                break
            outcome = rows.UNBALANCED
        if outcome == rows.SOLVED and steps.increment_out_of_bounds(fibres):
            outcome = rows.NO_FIBRE_SOLUTION
        if outcome != rows.SOLVED:
            return n, outcome, total
        if chambers is not None:
            steps.commit_chambers(step, ends, branch_states, sides, chambers, reservoirs, p, work)
        steps.commit_sides(step, waves, n, sides, chambers, p, work)
        steps.commit_branches(branches)
        steps.commit_fibres(active, step, sides, fibres)
        last[1], last[0] = last[0], length
        record_curves(sides, fibres, branches, chambers, curves, n + 1, changes)
    return rate.shape[0], rows.SOLVED, total


@njit(cache=True, error_model="numpy")
def advance(tissue, inputs, state, curves, first):  # type: ignore[no-untyped-def]
    """Take the steps from ``first`` on; return the index of the first failed step, its outcome and the iterations.

    Without a failure the index is n and the outcome SOLVED. The rows of ``curves`` (n + 1, 4 v + k + 2 c) are filled
    with volumes, pressures of ventricles and arteries, flows, volumes and pressures of c = v atria, and stretches,
    before the first and after every step. Each row holds those of the beat before, or NaN: from them, with the changes
    that the steps before have shown, the unknowns of a step start. A failed step leaves the state as it was at its
    start.
    """
    n = _unknowns(state.sides, state.chambers)
    equations = (
        np.empty(n),
        np.zeros((n, 3 + n)),
        np.empty((3, n)),
        np.empty((n, n)),
        np.empty((2, n + state.fibres.shape[1])),
    )
    workspace = (state.branches[rows.STEP_STATES :], *equations)
    tables = state.sides, state.fibres, state.branches, state.last
    return _advance(tissue, inputs, tables, state.chambers, state.reservoirs, curves, first, workspace)


@njit(cache=True, error_model="numpy")
def _unknowns(sides, chambers):  # type: ignore[no-untyped-def]
    """Number of unknown pressures: of ventricles and arteries, and of atria if one has a volume."""
    if chambers is None:
        return 2 * sides.shape[1]
    return 3 * sides.shape[1]

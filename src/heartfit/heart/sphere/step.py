"""Parts of one step of spherical ventricles in their circuit: starting values, prediction and final state.

Newton's method in the stretches, see :mod:`heartfit.heart.sphere.beat`, condenses every wall to its linear response to
pressure and solves the circuit to convergence, as for a mesh (:mod:`heartfit.heart.circulation.circuit`), so that the
kinks of the valves do not affect the walls. Starting values are those of :mod:`heartfit.heart.time_step`.
"""

from numba import njit

from heartfit.heart.circulation.atria import drain_arteries, end_atrium
from heartfit.heart.circulation.elements import advance_windkessel, affine_coefficients
from heartfit.heart.circulation.system import CONSTANT, ONE_KILOPASCAL, REFERENCE, STORAGE, WEIGHT
from heartfit.heart.muscle.control import available_fraction
from heartfit.heart.muscle.fibre_equation import LARGEST_INCREMENT, bridges
from heartfit.heart.muscle.spring import frozen_spring_slope, green_strain
from heartfit.heart.sphere import rows
from heartfit.heart.sphere.wall import CompiledStep, cavity
from heartfit.roles.chamber import (
    OUTSIDE,
    START_VEIN,
    START_VOLUME,
    STIFFENING,
    VEIN_END,
    VEINS,
    VOLUME,
)
from heartfit.roles.laws import (
    CLOSING_RATE,
    FLOW,
    INERTIA,
    OPENING,
    OPENING_RATE,
    START_FLOW,
    START_OPENING,
)


@njit(cache=True, error_model="numpy", inline="always")
def next_step(length, second_order, last):  # type: ignore[no-untyped-def]
    """Step of the given length [s] after one of length ``last``."""
    memory = length / (length + last) if second_order and last > 0.0 else 0.0
    effective = length / (1.0 + memory)
    return CompiledStep(
        length, second_order, memory, effective, effective * memory / last if memory > 0.0 else 0.0
    )


@njit(cache=True, error_model="numpy", inline="always")
def begin_sides(step, sides):  # type: ignore[no-untyped-def]
    """Set the starting values of the sides."""
    gain = step.gain
    for v in range(sides.shape[1]):
        for row in range(rows.REMEMBERED):
            now, before = sides[rows.NOW + row, v], sides[rows.BEFORE + row, v]
            sides[rows.START + row, v] = now + gain * (now - before)
        stretch, old, radius, ratio = (
            sides[rows.NOW, v],
            sides[rows.BEFORE, v],
            sides[rows.RADIUS, v],
            sides[rows.RATIO, v],
        )
        volume, square, former = cavity(radius, ratio, stretch)[0], stretch * stretch, old * old
        sides[rows.START_VOLUME, v] = volume + gain * (volume - cavity(radius, ratio, old)[0])
        sides[rows.START_PLANE, v] = square + gain * (square - former)
        sides[rows.START_RADIAL, v] = (1.0 + gain) / (square * square) - gain / (former * former)


@njit(cache=True, error_model="numpy", inline="always")
def begin_branches(step, branches):  # type: ignore[no-untyped-def]
    """Set the starting flows and openings, and the constants of the branches over the effective length of the step."""
    for k in range(branches.shape[1]):
        now, before = branches[rows.FLOW, k], branches[rows.FLOW_BEFORE, k]
        branches[rows.STEP_STATES + START_FLOW, k] = now + step.gain * (now - before)
        branches[rows.STEP_STATES + INERTIA, k] = branches[rows.INERTANCE, k] / step.effective
        now, before = branches[rows.OPENING, k], branches[rows.OPENING_BEFORE, k]
        extrapolated = now + step.gain * (now - before)
        branches[rows.STEP_STATES + START_OPENING, k] = min(max(extrapolated, 0.0), 1.0)
        branches[rows.STEP_STATES + OPENING_RATE, k] = branches[rows.OPENS, k] * step.effective
        branches[rows.STEP_STATES + CLOSING_RATE, k] = branches[rows.CLOSES, k] * step.effective


@njit(cache=True, error_model="numpy", inline="always")
def begin_chambers(step, walls, n, chambers, reservoirs):  # type: ignore[no-untyped-def]
    """Set the starting values of atria and veins, and the walls of the atria at the end of step n."""
    for v in range(chambers.shape[1]):
        volume, vein = reservoirs[0, v], reservoirs[1, v]
        chambers[START_VOLUME, v] = volume + step.gain * (volume - reservoirs[2, v])
        chambers[START_VEIN, v] = vein + step.gain * (vein - reservoirs[3, v])
        chambers[STIFFENING, v], chambers[OUTSIDE, v] = walls[n, 0, v], walls[n, 1, v]


@njit(cache=True, error_model="numpy", inline="always")
def begin_arteries(step, waves, n, sides, chambers, system):  # type: ignore[no-untyped-def]
    """Set the equations of the arteries, p - a - b q - c P = 0, with their ``waves`` and their own compliance."""
    count = sides.shape[1]
    for v in range(count):
        a, b = affine_coefficients(
            sides[rows.R_P, v],
            sides[rows.TAU, v],
            sides[rows.Z_C, v],
            sides[rows.L, v],
            sides[rows.P_VE, v],
            sides[rows.START + rows.P_C, v],
            sides[rows.START + rows.Q_L, v],
            step.effective,
        )
        a, b, c = drain_arteries(
            chambers,
            v,
            step.effective,
            sides[rows.R_P, v],
            sides[rows.TAU, v],
            sides[rows.START + rows.P_C, v],
            a,
            b,
            waves[n, v],
        )
        a += waves[n, v]
        stiff = sides[rows.OWN_COMPLIANCE, v] / step.effective
        c = c / (1.0 + b * stiff)
        b = b / (1.0 + b * stiff)
        a += b * stiff * (sides[rows.START + rows.ARTERY, v] - a)
        row = count + v
        system[row, WEIGHT], system[row, STORAGE + row] = b / ONE_KILOPASCAL, 1.0 / ONE_KILOPASCAL
        system[row, CONSTANT], system[row, REFERENCE] = 0.0, a
        if chambers is not None and count == 2:
            system[row, STORAGE + 2 * count + 1 - v] = -c / ONE_KILOPASCAL


@njit(cache=True, error_model="numpy", inline="always")
def begin_fibres(active, starling, step, rate, attach, n, sides, fibres):  # type: ignore[no-untyped-def]
    """Set the drive of the fibres in step n, mean rates and n_0; the guess leaves their springs unchanged."""
    ahead, additive = 0.5 * step.length if step.second_order else 0.0, active[5] > 0.0
    count = fibres.shape[1] // sides.shape[1]
    for i in range(fibres.shape[1]):
        e_c, stretch = fibres[rows.E_C, i], sides[rows.NOW + rows.STRETCH, i // count]
        fibres[rows.U, i], fibres[rows.U_PLUS, i] = rate[n, i], attach[n, i]
        length = green_strain(additive, e_c + ahead * fibres[rows.RATE, i])
        fibres[rows.N_0, i] = fibres[rows.KEPT, i] * available_fraction(length, starling)
        fibres[rows.INCREMENT, i] = 0.0
        fibres[rows.INCREMENT_SLOPE, i] = frozen_spring_slope(additive, 0.5 * (stretch * stretch - 1.0), e_c)


@njit(cache=True, error_model="numpy", inline="always")
def follow_walls(sides, fibres):  # type: ignore[no-untyped-def]
    """Update the responses of the fibres to the last change of the stretches, along their slopes."""
    count = fibres.shape[1] // sides.shape[1]
    for i in range(fibres.shape[1]):
        x, before = sides[rows.X, i // count], sides[rows.X_BEFORE, i // count]
        move = 0.5 * (x * x - before * before)
        fibres[rows.SIGMA, i] += fibres[rows.SLOPE, i] * move
        fibres[rows.INCREMENT, i] += fibres[rows.INCREMENT_SLOPE, i] * move


@njit(cache=True, error_model="numpy", inline="always")
def commit_chambers(step, ends, branch_states, sides, chambers, reservoirs, p, work):  # type: ignore[no-untyped-def]
    """Store volumes and veins of the atria, from the flows of the branches.

    ``work`` is overwritten: row 0 by the net outflow of ventricles, arteries and atria, row 1 by the inflow of the
    Windkessels.
    """
    count = chambers.shape[1]
    for i in range(3 * count):
        work[0, i] = 0.0
    for k in range(ends.shape[0]):
        for end, sign in ((0, 1.0), (1, -1.0)):
            side, place = ends[k, end] % 2, ends[k, end] // 2
            work[0, place * count + side] += sign * branch_states[FLOW, k]
    for v in range(count):
        stiff = sides[rows.OWN_COMPLIANCE, v] / step.effective
        swelling = stiff * (p[count + v] - sides[rows.START + rows.ARTERY, v])
        work[1, v] = -work[0, count + v] - swelling
    for v in range(count):
        inflow, i = work[1, count - 1 - v], 2 * count + v
        end_atrium(chambers, v, step.effective, inflow, work[0, i], p[i])
        reservoirs[2, v], reservoirs[3, v] = reservoirs[0, v], reservoirs[1, v]
        reservoirs[0, v], reservoirs[1, v] = chambers[VOLUME, v], chambers[VEIN_END, v]


@njit(cache=True, error_model="numpy", inline="always")
def commit_sides(step, waves, n, sides, chambers, p, work):  # type: ignore[no-untyped-def]
    """Store the solution in the table of the sides; row 1 of ``work`` holds the inflow of arteries that fill veins."""
    count = sides.shape[1]
    for v in range(count):
        for row in range(rows.REMEMBERED):
            sides[rows.OLDER + row, v], sides[rows.BEFORE + row, v] = (
                sides[rows.BEFORE + row, v],
                sides[rows.NOW + row, v],
            )
        fills, venous = False, sides[rows.P_VE, v]
        if chambers is not None:
            fills = count == 2 and chambers[VEINS, 1 - v] > 0.0
            venous = chambers[VEIN_END, 1 - v] if fills else venous
        tree = (
            sides[rows.R_P, v],
            sides[rows.TAU, v],
            sides[rows.Z_C, v],
            sides[rows.L, v],
            venous,
        )
        state = sides[rows.START + rows.P_C, v], sides[rows.START + rows.Q_L, v]
        a, b = affine_coefficients(*tree, *state, step.effective)
        inflow = work[1, v] if fills else (p[count + v] - waves[n, v] - a) / b
        sides[rows.NOW + rows.P_C, v], sides[rows.NOW + rows.Q_L, v] = advance_windkessel(
            *tree, *state, inflow, step.effective
        )
        sides[rows.NOW + rows.SPEED, v] = (
            sides[rows.X, v] - sides[rows.START + rows.STRETCH, v]
        ) / step.effective
        sides[rows.NOW + rows.STRETCH, v], sides[rows.NOW + rows.ARTERY, v] = sides[rows.X, v], p[count + v]
        sides[rows.P, v] = p[v]


@njit(cache=True, error_model="numpy", inline="always")
def commit_branches(branches):  # type: ignore[no-untyped-def]
    """Store the new flows and openings of the branches."""
    for k in range(branches.shape[1]):
        for row, trial in ((rows.FLOW, FLOW), (rows.OPENING, OPENING)):
            branches[row + 2, k], branches[row, k] = branches[row, k], branches[rows.STEP_STATES + trial, k]


@njit(cache=True, error_model="numpy", inline="always")
def commit_fibres(active, step, sides, fibres):  # type: ignore[no-untyped-def]
    """Store the new states of the fibres, and their mean stress in the table of the sides."""
    count = fibres.shape[1] // sides.shape[1]
    for v in range(sides.shape[1]):
        sides[rows.STRESS, v] = 0.0
        for i in range(v * count, (v + 1) * count):
            d, k, lam = fibres[rows.INCREMENT, i], fibres[rows.K_C, i], fibres[rows.LAMBDA, i]
            rate, attach, n_0 = fibres[rows.U, i], fibres[rows.U_PLUS, i], fibres[rows.N_0, i]
            stiffness, mean, _, _, _, _ = bridges(
                d, rate, attach, n_0, step.length, step.second_order, active, k, lam
            )
            fibres[rows.E_C, i] += d
            fibres[rows.K_C, i], fibres[rows.LAMBDA, i] = stiffness, 2.0 * mean - lam
            fibres[rows.RATE, i] = d / step.length
            sides[rows.STRESS, v] += fibres[rows.SIGMA, i] / count


@njit(cache=True, error_model="numpy", inline="always")
def increment_out_of_bounds(fibres):  # type: ignore[no-untyped-def]
    """True if the increment of a fibre reached its bound, below which its equation has no solution."""
    largest = 0.0
    for i in range(fibres.shape[1]):
        largest = max(largest, abs(fibres[rows.INCREMENT, i]))
    return largest >= LARGEST_INCREMENT

r"""One step of spherical ventricles in their circuit: Newton's method in the stretches.

In every iteration each wall is replaced by its linear response to pressure, and the circuit is solved to the end, as
for a mesh (:mod:`heartfit.circulation.circuit`): the kinks of the valves never meet the wall. Starting values are
those of :mod:`heartfit.mechanics.time_step`.
"""

from numba import njit

from heartfit.circulation.circuit import ABOUT, GAP, ONE_KILOPASCAL, STORED, WEIGHT
from heartfit.circulation.windkessel import advanced, affine
from heartfit.mechanics.active.bcs import LARGEST_INCREMENT, bridges, green_strain, unchanged_spring
from heartfit.mechanics.active.starling import available
from heartfit.sphere import rows as at
from heartfit.sphere.wall import Step, cavity


@njit(cache=True, error_model="numpy", inline="always")
def time_step(length, second_order, last):  # type: ignore[no-untyped-def]
    """The step after one of length ``last``."""
    memory = length / (length + last) if second_order and last > 0.0 else 0.0
    effective = length / (1.0 + memory)
    return Step(length, second_order, memory, effective, effective * memory / last if memory > 0.0 else 0.0)


@njit(cache=True, error_model="numpy", inline="always")
def begin_sides(step, sides):  # type: ignore[no-untyped-def]
    """Starting values of the sides."""
    gain = step.gain
    for v in range(sides.shape[1]):
        for row in range(at.REMEMBERED):
            now, before = sides[at.NOW + row, v], sides[at.BEFORE + row, v]
            sides[at.START + row, v] = now + gain * (now - before)
        stretch, old, radius, ratio = (
            sides[at.NOW, v],
            sides[at.BEFORE, v],
            sides[at.RADIUS, v],
            sides[at.RATIO, v],
        )
        volume, square, former = cavity(radius, ratio, stretch)[0], stretch * stretch, old * old
        sides[at.START_VOLUME, v] = volume + gain * (volume - cavity(radius, ratio, old)[0])
        sides[at.START_PLANE, v] = square + gain * (square - former)
        sides[at.START_RADIAL, v] = (1.0 + gain) / (square * square) - gain / (former * former)


@njit(cache=True, error_model="numpy", inline="always")
def begin_branches(step, branches):  # type: ignore[no-untyped-def]
    """Starting values of the flows."""
    for k in range(branches.shape[1]):
        now, before = branches[at.FLOW, k], branches[at.FLOW_BEFORE, k]
        branches[at.START_FLOW, k] = now + step.gain * (now - before)
        branches[at.PER_STEP, k] = branches[at.INERTANCE, k] / step.effective


@njit(cache=True, error_model="numpy", inline="always")
def begin_arteries(step, waves, n, sides, system):  # type: ignore[no-untyped-def]
    """Equations of the arteries, p - a - b q = 0, with the waves in them and their own compliance."""
    count = sides.shape[1]
    for v in range(count):
        a, b = affine(
            sides[at.R_P, v],
            sides[at.TAU, v],
            sides[at.Z_C, v],
            sides[at.L, v],
            sides[at.P_VE, v],
            sides[at.START + at.P_C, v],
            sides[at.START + at.Q_L, v],
            step.effective,
        )
        a += waves[n, v]
        stiff = sides[at.OWN_COMPLIANCE, v] / step.effective
        b = b / (1.0 + b * stiff)
        a += b * stiff * (sides[at.START + at.ARTERY, v] - a)
        row = count + v
        system[row, WEIGHT], system[row, STORED + row] = b / ONE_KILOPASCAL, 1.0 / ONE_KILOPASCAL
        system[row, GAP], system[row, ABOUT] = 0.0, a


@njit(cache=True, error_model="numpy", inline="always")
def begin_fibres(active, starling, step, rate, attach, n, sides, fibres):  # type: ignore[no-untyped-def]
    """Drive of the fibres, mean rates and n_0 of step n; their springs start unchanged."""
    ahead, additive = 0.5 * step.length if step.second_order else 0.0, active[5] > 0.0
    count = fibres.shape[1] // sides.shape[1]
    for i in range(fibres.shape[1]):
        e_c, stretch = fibres[at.E_C, i], sides[at.NOW + at.STRETCH, i // count]
        fibres[at.U, i], fibres[at.U_PLUS, i] = rate[n, i], attach[n, i]
        length = green_strain(additive, e_c + ahead * fibres[at.RATE, i])
        fibres[at.N_0, i] = fibres[at.KEPT, i] * available(length, starling)
        fibres[at.INCREMENT, i] = 0.0
        fibres[at.TURN, i] = unchanged_spring(additive, 0.5 * (stretch * stretch - 1.0), e_c)


@njit(cache=True, error_model="numpy", inline="always")
def guess(step, last, sides, row, v):  # type: ignore[no-untyped-def]
    """Extrapolation of a remembered quantity over the lengths of the last two steps, as far as there were any."""
    x, y, z = sides[at.NOW + row, v], sides[at.BEFORE + row, v], sides[at.OLDER + row, v]
    if last[0] == 0.0:
        return x
    rate = (x - y) / last[0]
    if last[1] == 0.0:
        return x + step.length * rate
    return x + step.length * (2.0 * rate - (y - z) / last[1])


@njit(cache=True, error_model="numpy", inline="always")
def predict(step, last, sides, p):  # type: ignore[no-untyped-def]
    """First guess of the stretches and of the arterial pressures."""
    count = sides.shape[1]
    for v in range(count):
        sides[at.X, v], sides[at.X_BEFORE, v] = (
            guess(step, last, sides, at.STRETCH, v),
            sides[at.NOW + at.STRETCH, v],
        )
        p[count + v] = guess(step, last, sides, at.ARTERY, v)


@njit(cache=True, error_model="numpy", inline="always")
def follow(sides, fibres):  # type: ignore[no-untyped-def]
    """Let the fibres follow the last move of the stretches along their slopes."""
    count = fibres.shape[1] // sides.shape[1]
    for i in range(fibres.shape[1]):
        x, before = sides[at.X, i // count], sides[at.X_BEFORE, i // count]
        move = 0.5 * (x * x - before * before)
        fibres[at.SIGMA, i] += fibres[at.SLOPE, i] * move
        fibres[at.INCREMENT, i] += fibres[at.TURN, i] * move


@njit(cache=True, error_model="numpy", inline="always")
def commit_sides(step, waves, n, sides, p):  # type: ignore[no-untyped-def]
    """Take the solution over into the memory of the sides."""
    count = sides.shape[1]
    for v in range(count):
        for row in range(at.REMEMBERED):
            sides[at.OLDER + row, v], sides[at.BEFORE + row, v] = (
                sides[at.BEFORE + row, v],
                sides[at.NOW + row, v],
            )
        tree = sides[at.R_P, v], sides[at.TAU, v], sides[at.Z_C, v], sides[at.L, v], sides[at.P_VE, v]
        held = sides[at.START + at.P_C, v], sides[at.START + at.Q_L, v]
        a, b = affine(*tree, *held, step.effective)
        inflow = (p[count + v] - waves[n, v] - a) / b
        sides[at.NOW + at.P_C, v], sides[at.NOW + at.Q_L, v] = advanced(*tree, *held, inflow, step.effective)
        sides[at.NOW + at.SPEED, v] = (sides[at.X, v] - sides[at.START + at.STRETCH, v]) / step.effective
        sides[at.NOW + at.STRETCH, v], sides[at.NOW + at.ARTERY, v] = sides[at.X, v], p[count + v]
        sides[at.P, v] = p[v]


@njit(cache=True, error_model="numpy", inline="always")
def commit_branches(branches):  # type: ignore[no-untyped-def]
    for k in range(branches.shape[1]):
        branches[at.FLOW_BEFORE, k], branches[at.FLOW, k] = branches[at.FLOW, k], branches[at.TRIAL_FLOW, k]


@njit(cache=True, error_model="numpy", inline="always")
def commit_fibres(active, step, sides, fibres):  # type: ignore[no-untyped-def]
    """Take the fibres over into their state, and their mean stress into the memory of the sides."""
    count = fibres.shape[1] // sides.shape[1]
    for v in range(sides.shape[1]):
        sides[at.STRESS, v] = 0.0
        for i in range(v * count, (v + 1) * count):
            d, lam = fibres[at.INCREMENT, i], fibres[at.LAMBDA, i]
            drive = fibres[at.U, i], fibres[at.U_PLUS, i], fibres[at.N_0, i], step.length, step.second_order
            stiffness, mean, _, _ = bridges(d, *drive, active, fibres[at.K_C, i], lam)
            fibres[at.E_C, i] += d
            fibres[at.K_C, i], fibres[at.LAMBDA, i] = stiffness, 2.0 * mean - lam
            fibres[at.RATE, i] = d / step.length
            sides[at.STRESS, v] += fibres[at.SIGMA, i] / count


@njit(cache=True, error_model="numpy", inline="always")
def torn(fibres):  # type: ignore[no-untyped-def]
    """Whether a fibre met the bound of its increment: its equation has no solution in it then."""
    largest = 0.0
    for i in range(fibres.shape[1]):
        largest = max(largest, abs(fibres[at.INCREMENT, i]))
    return largest >= LARGEST_INCREMENT

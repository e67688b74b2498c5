"""Initial guesses of the unknowns of a step: stretches, pressures of arteries and atria, increments of the fibres.

In the first beat they are extrapolated from the steps before. Later beats resemble each other: there they are the
values of the beat before with the changes that the last two steps have shown, and most steps need one iteration.
"""

import numpy as np
from numba import njit

from heartfit.heart.sphere import rows
from heartfit.roles.chamber import PRESSURE


@njit(cache=True, error_model="numpy", inline="always")
def store(curves, n, column, changes, i, value):  # type: ignore[no-untyped-def]
    """Store unknown i of a step in its column, and its change from the beat before next to that one step earlier."""
    changes[1, i], changes[0, i] = changes[0, i], value - curves[n, column]
    curves[n, column] = value


@njit(cache=True, error_model="numpy", inline="always")
def keep_changes(changes):  # type: ignore[no-untyped-def]
    """Take the changes before the first step for those one step earlier."""
    for i in range(changes.shape[1]):
        changes[1, i] = changes[0, i]


@njit(cache=True, error_model="numpy", inline="always")
def carry(curves, n, column, changes, i):  # type: ignore[no-untyped-def]
    """Value of unknown i in the beat before, with its extrapolated change."""
    return curves[n, column] + 2.0 * changes[0, i] - changes[1, i]


@njit(cache=True, error_model="numpy", inline="always")
def predict(step, last, curves, n, changes, sides, fibres, chambers, p):  # type: ignore[no-untyped-def]
    """Set the initial guess of all unknowns: those of the beat before in row n of the ``curves`` with their changes.

    Where the row is NaN, stretches and pressures of arteries are extrapolated from the steps before.
    """
    if np.isnan(curves[n, 0]):
        predict_from_steps(step, last, sides, chambers, p)
        return
    count, width = sides.shape[1], curves.shape[1]
    if chambers is not None:
        for v in range(count):
            p[2 * count + v] = carry(
                curves, n, width - fibres.shape[1] - 2 * count + v, changes, 2 * count + v
            )
    for v in range(count):
        sides[rows.X, v] = carry(curves, n, width - count + v, changes, v)
        sides[rows.X_BEFORE, v] = sides[rows.X, v]
        p[count + v] = carry(curves, n, 2 * count + v, changes, count + v)
    own, increments = changes.shape[1] - fibres.shape[1], width - count - fibres.shape[1]
    for i in range(fibres.shape[1]):
        fibres[rows.INCREMENT, i] = carry(curves, n, increments + i, changes, own + i)


@njit(cache=True, error_model="numpy", inline="always")
def predict_from_steps(step, last, sides, chambers, p):  # type: ignore[no-untyped-def]
    """Set the initial guess from the steps before; atria keep their pressures."""
    count = sides.shape[1]
    if chambers is not None:
        for v in range(count):
            p[2 * count + v] = chambers[PRESSURE, v]
    for v in range(count):
        sides[rows.X_BEFORE, v] = sides[rows.NOW + rows.STRETCH, v]
        sides[rows.X, v] = extrapolate(step, last, sides, rows.STRETCH, v)
        p[count + v] = extrapolate(step, last, sides, rows.ARTERY, v)


@njit(cache=True, error_model="numpy", inline="always")
def extrapolate(step, last, sides, row, v):  # type: ignore[no-untyped-def]
    """Extrapolate a stored quantity from up to three times, ``last`` (2,) being the lengths of the last steps [s]."""
    x, y, z = sides[rows.NOW + row, v], sides[rows.BEFORE + row, v], sides[rows.OLDER + row, v]
    if last[0] == 0.0:
        return x
    rate = (x - y) / last[0]
    if last[1] == 0.0:
        return x + step.length * rate
    return x + step.length * (2.0 * rate - (y - z) / last[1])

r"""Limit cycles of hearts near another one, each about three beats from there.

A beat maps the state s at its start to B(s) at its end, and shows the curves C(s). From one beat to the next a heart
remembers little more than z: the pressures of its Windkessels, and a little of the stretches of its walls. So about the
limit cycle :math:`s^* = B(s^*)` of the centre, a move :math:`\sigma` of the start moves the end and the curves by

.. math:: B(s^* + \sigma) - B(s^*) = J \sigma, \qquad C(s^* + \sigma) - C(s^*) = S \sigma ,

which z of :math:`\sigma` determines. With the pressure of a Windkessel raised, two beats of the centre show two such
moves: the raised pressure itself, and what is left of it after the first beat. A neighbour, whose parameters differ a
little, starts at :math:`s^*`. Newton's method, with weights w of all :math:`\sigma_i`, corrects the end of each of its
beats, where the next one starts, and its curves,

.. math:: \sum_i w_i\, z(\sigma_i - J \sigma_i) = z(B(s) - s), \qquad
          s' = B(s) + \sum_i w_i\, J \sigma_i, \qquad C' = C(s) + \sum_i w_i\, S \sigma_i ,

until :math:`\Delta_k^2 / \Delta_{k-1}`, of the changes :math:`\Delta` of the corrected z, is small.

Every step starts from the values of the beat before, here of the centre, so that most of them need one iteration.
"""

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.finite_elements.kinematics import StepFailed
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere import rows
from heartfit.heart.sphere.beat import State
from heartfit.heart.sphere.heart import SphericalHeart
from heartfit.heart.sphere.simulation import LimitCycle, SphereRun, shift_pressures

PRESSURE = rows.NOW + rows.P_C
PRESSURE_SIZE = 1e-3
"""Relative rise of the pressure of a Windkessel before the beats that measure the response to it."""

CONVERGED, MOST_BEATS = 1e-9, 6
"""Relative error of stretches and pressures, as their last changes let expect, below which a beat is the limit cycle,
and the number of beats after which a heart counts as too far."""


class Neighbours:
    """Hearts near the one on a limit cycle, whose atria have no volume."""

    def __init__(self, centre: LimitCycle, numerics: Numerics) -> None:
        if centre.heart.atria is not None:
            raise ValueError(
                "neighbours: an atrium of the centre has a volume, expected prescribed pressures"
            )
        self._numerics, self._state, self._curves = numerics, centre.state, centre.curves
        run, pressures = SphereRun(centre.heart, numerics), centre.state.sides[PRESSURE]
        own = self._beat_twice(run, np.zeros_like(pressures))
        moves = [_moves(self._beat_twice(run, rise), own) for rise in np.diag(PRESSURE_SIZE * pressures)]
        starts = [tables for move in moves for tables in move[:-1]]
        ends = [tables for move in moves for tables in move[1:]]
        slow = [_slow(start) - _slow(end) for (start, *_), (end, *_) in zip(starts, ends, strict=True)]
        self._weights = np.linalg.pinv(np.column_stack(slow))
        self._ends = [np.stack(table, axis=-1) for table in zip(*ends, strict=True)]

    def limit_cycle(self, heart: SphericalHeart) -> LimitCycle | None:
        """The limit cycle of a neighbour; None where it is too far for the responses, or does not beat."""
        run, state = SphereRun(heart, self._numerics), heart.take_over(self._state)
        curves, change = self._curves.copy(), np.inf
        try:
            while run.drift > CONVERGED:
                if run.beats == MOST_BEATS:
                    return None
                last, change = change, self._beat_and_correct(run, state, curves)
                run.drift = change * min(change / last, 1.0) if run.beats > 1 else change
        except StepFailed:
            return None
        return run.limit_cycle(state, curves)

    def _beat_twice(self, run: SphereRun, rise: Floats) -> list[list[Floats]]:
        """Tables at the centre, with the pressures raised (v,) [Pa], and at the ends of two beats from there."""
        state, curves = run.heart.take_over(self._state), self._curves.copy()
        shift_pressures(state, rise)
        tables = [_copies(state, curves)]
        for _ in range(2):
            run.run_beat(state, curves)
            tables.append(_copies(state, curves))
        return tables

    def _beat_and_correct(self, run: SphereRun, state: State, curves: Floats) -> float:
        """Run a beat, move its end and its curves to the limit cycle, and return the relative change of z."""
        start = _slow(state.sides)
        run.run_beat(state, curves)
        weights: Floats = self._weights @ (_slow(state.sides) - start)
        for table, moves in zip(_tables(state, curves), self._ends, strict=True):
            table += moves @ weights
        return float(np.abs(_slow(state.sides) / start - 1.0).max())


def _slow(sides: Floats) -> Floats:
    """Stretches and pressures of the Windkessels [Pa], (2 v,), in the table of the sides."""
    return np.concatenate([sides[rows.NOW + rows.STRETCH], sides[PRESSURE]])


def _tables(state: State, curves: Floats) -> list[Floats]:
    return [state.sides, state.fibres, state.branches, curves]


def _copies(state: State, curves: Floats) -> list[Floats]:
    return [table.copy() for table in _tables(state, curves)]


def _moves(raised: list[list[Floats]], centre: list[list[Floats]]) -> list[list[Floats]]:
    """Differences of the tables from those of the centre, before and after each beat."""
    return [[new - old for new, old in zip(*pair, strict=True)] for pair in zip(raised, centre, strict=True)]

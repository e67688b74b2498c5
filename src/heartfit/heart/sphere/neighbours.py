r"""Limit cycles of hearts near another one, each in three or four beats from there.

A beat maps the state s at its start to B(s) at its end, and shows the curves C(s). From one beat to the next a heart
remembers little more than the pressures P of its Windkessels: its walls relax in between. So about the limit cycle
:math:`s^*` of the centre

.. math:: B(s) = B(s^*) + D (P - P^*), \qquad C(s) = C(s^*) + S (P - P^*),

with responses D and S that one more beat for each Windkessel measures. A neighbour, whose parameters differ a little,
starts at :math:`s^*`. Newton's method, with the rows :math:`\Lambda` of D that are pressures, corrects the end of each
of its beats, where the next one starts, and its curves,

.. math:: r = (I - \Lambda)^{-1} (P_{B(s)} - P_s), \qquad s' = B(s) + D\, r, \qquad C' = C(s) + S\, r ,

until :math:`\Delta_k^2 / \Delta_{k-1}`, of the changes :math:`\Delta` of the corrected state, is small.

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
"""Relative rise of the pressure of a Windkessel in the beat that measures the response to it."""

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
        run, sizes = SphereRun(centre.heart, numerics), PRESSURE_SIZE * _pressures(centre.state)
        onward = self._beat_on(run, np.zeros(len(sizes)))
        raised = [self._beat_on(run, rise) for rise in np.diag(sizes)]
        self._responses = [
            [(new - old) / size for new, old in zip(tables, onward, strict=True)]
            for tables, size in zip(raised, sizes, strict=True)
        ]
        matrix = np.column_stack([sides[PRESSURE] for sides, *_ in self._responses])
        self._amplification = np.linalg.inv(np.eye(len(sizes)) - matrix)

    def limit_cycle(self, heart: SphericalHeart) -> LimitCycle | None:
        """The limit cycle of a neighbour; None where it is too far for the responses, or does not beat."""
        run, state = SphereRun(heart, self._numerics), heart.take_over(self._state)
        curves, change = self._curves.copy(), np.inf
        try:
            while run.drift > CONVERGED:
                if run.beats == MOST_BEATS:
                    return None
                before, last = _slow(state), change
                self._beat_and_correct(run, state, curves)
                change = float(np.abs(_slow(state) / before - 1.0).max())
                run.drift = change * min(change / last, 1.0) if run.beats > 1 else change
        except StepFailed:
            return None
        return run.limit_cycle(state, curves)

    def _beat_on(self, run: SphereRun, rise: Floats) -> list[Floats]:
        """Tables of the state and curves of the centre's next beat, with the pressures raised before it (v,) [Pa]."""
        state, curves = run.heart.take_over(self._state), self._curves.copy()
        shift_pressures(state, rise)
        run.run_beat(state, curves)
        return _tables(state, curves)

    def _beat_and_correct(self, run: SphereRun, state: State, curves: Floats) -> None:
        """Run a beat, and move its end and its curves to the limit cycle."""
        start = _pressures(state)
        run.run_beat(state, curves)
        rise: Floats = self._amplification @ (_pressures(state) - start)
        for size, response in zip(rise, self._responses, strict=True):
            for table, per_pascal in zip(_tables(state, curves), response, strict=True):
                table += size * per_pascal


def _pressures(state: State) -> Floats:
    """Pressures (v,) of the Windkessels [Pa]."""
    return state.sides[PRESSURE].copy()


def _slow(state: State) -> Floats:
    """Stretches and pressures of the Windkessels [Pa], (2 v,), at the end of a beat."""
    return np.concatenate([state.sides[rows.NOW + rows.STRETCH], state.sides[PRESSURE]])


def _tables(state: State, curves: Floats) -> list[Floats]:
    return [state.sides, state.fibres, state.branches, curves]

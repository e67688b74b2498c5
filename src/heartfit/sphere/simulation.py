"""Beats of spherical ventricles until the limit cycle, as :func:`heartfit.simulation.simulate` runs those of meshes."""

import time as clock
from collections.abc import Sequence

import numpy as np

from heartfit.beat import COST, Beat, failed_beat
from heartfit.circulation.windkessel import WindkesselState
from heartfit.geometry.arrays import Floats
from heartfit.heart import Heart
from heartfit.limit_cycle import Recurrence
from heartfit.mechanics.kinematics import StepFailed
from heartfit.mechanics.sphere import ACTIVATION, Sphere
from heartfit.mechanism import COMPARTMENTS
from heartfit.simulation import Numerics
from heartfit.sphere import rows as at
from heartfit.sphere.beat import Course, State, advance
from heartfit.sphere.heart import Inertia, SphericalHeart

REASONS = (
    "",
    "the walls and the circuit find no balance",
    "a sphere is stretched out of bounds",
    "a wall has no stiffness, or none that is finite",
    "the sarcomere equation of a fibre has no solution",
)
"""Why a step failed, by outcome."""

RAISED = [time + row for time in (at.NOW, at.BEFORE, at.OLDER) for row in (at.ARTERY, at.P_C)]
"""Rows of the pressures that are shifted between beats."""


def simulate_spheres(
    heart: Heart,
    spheres: Sequence[Sphere],
    numerics: Numerics | None = None,
    activation: Floats = ACTIVATION,
    inertia: Inertia | None = None,
) -> Beat:
    """Beat of ``heart`` on its limit cycle, its left ventricle, or both, being ``spheres``.

    The equations, the scheme and the approach to the limit cycle are those of a
    :class:`~heartfit.mechanics.sphere.SphericalBody` in :func:`~heartfit.simulation.simulate`, compiled as a whole. A
    left ventricle alone keeps the branches among its own compartments. ``activation`` (k,), s, are the times of the
    fibre classes of each sphere. Tolerances of ``numerics`` are not used: a step is solved to 1e-5 mL and 0.01 Pa.
    """
    numerics = numerics or Numerics()
    run = _Run(
        SphericalHeart(heart, spheres, activation, inertia or Inertia(), numerics.second_order), numerics
    )
    try:
        return run.to_limit_cycle()
    except StepFailed as failure:
        return failed_beat(f"beat {run.beats + 1}: {failure}", heart.period, heart.trigger, run.diagnostics())


class _Run:
    def __init__(self, heart: SphericalHeart, numerics: Numerics) -> None:
        self._started = clock.thread_time()
        self.heart, self.numerics, self.period = heart, numerics, heart.heart.period
        self.steps = round(self.period / numerics.time_step)
        self.beats = self.cuts = self.iterations = self.outcome = 0
        self.drift = np.inf

    def to_limit_cycle(self) -> Beat:
        state, length = self.heart.start(), self.period / self.steps
        before: Recurrence | None = None
        course = self.heart.course(length * np.arange(float(self.steps)), length)
        curves = np.empty((self.steps + 1, 3 * len(self.heart.spheres) + len(self.heart.branches)))
        while True:
            first = _windkessels(state)
            self._beat_of(course, state, curves)
            self.beats += 1
            cycle = Recurrence(curves[:, : len(self.heart.spheres)], first, _windkessels(state))
            self.drift = cycle.drift()
            if self.drift < self.numerics.drift or self.beats == self.numerics.max_beats:
                return self._beat(curves)
            _raise(state, cycle.shifts(self.heart.trees, self.period, before))
            before = cycle

    def _beat_of(self, course: Course, state: State, curves: Floats) -> None:
        done = self._steps(course, state, curves, 0)
        while done < self.steps:
            self._cut(state, course.length * done, course.length, self.numerics.cuts)
            done = self._steps(course, state, curves, done + 1)

    def _steps(self, course: Course, state: State, curves: Floats, first: int) -> int:
        done, self.outcome, iterations = advance(self.heart.tissue, course, state, curves, first)
        self.iterations += iterations
        return int(done)

    def _cut(self, state: State, start: float, length: float, cuts: int) -> None:
        """Take the step that failed in two halves."""
        if cuts == 0:
            raise StepFailed(f"at {start:.4f} s, step {length:.2g} s: {REASONS[self.outcome]}")
        self.cuts, half = self.cuts + 1, 0.5 * length
        scratch = np.empty((2, 3 * len(self.heart.spheres) + len(self.heart.branches)))
        state.last[1] = 0.0
        for begin in (start, start + half):
            if not self._steps(self.heart.course(np.array([begin]), half), state, scratch, 0):
                self._cut(state, begin, half, cuts - 1)
        state.last[1] = 0.0

    def _beat(self, curves: Floats) -> Beat:
        heart, v = self.heart.heart, len(self.heart.spheres)
        time = np.linspace(0.0, self.period, self.steps + 1)
        atria = self.heart.atria(time)
        curves[0, 3 * v :] = self.heart.flows(curves[0, v : 3 * v], curves[0, 3 * v :])
        signals = [*curves[:, v : 3 * v].T, *atria]
        names = [name for each in range(3) for name in COMPARTMENTS[2 * each : 2 * each + v]]
        return Beat(
            time=time,
            volume=dict(zip(COMPARTMENTS, curves[:, :v].T, strict=False)),
            pressure=dict(zip(names, signals, strict=True)),
            flow=dict(zip(self.heart.branches, curves[:, 3 * v :].T, strict=True)),
            period=heart.period,
            trigger=heart.trigger,
            diagnostics=self.diagnostics() | {"wall_volume_loss": 0.0},
        )

    def diagnostics(self) -> dict[str, float]:
        """What the run cost and how periodic it became."""
        return {
            "beats": float(self.beats),
            "drift": float(self.drift),
            "step_cuts": float(self.cuts),
            "iterations": float(self.iterations),
            COST: clock.thread_time() - self._started,
        }


def _windkessels(state: State) -> list[WindkesselState]:
    return [WindkesselState(*held) for held in state.sides[[at.NOW + at.P_C, at.NOW + at.Q_L]].T.tolist()]


def _raise(state: State, shifts: Sequence[float]) -> None:
    """Raise the pressures of the arteries and of their Windkessels, now and before."""
    state.sides[RAISED] += shifts

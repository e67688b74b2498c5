"""Beats of spherical ventricles until the limit cycle; see :func:`heartfit.heart.simulation.simulate` for meshes."""

import time as clock
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.beat import COST, Beat, failed_beat
from heartfit.heart.circulation.atria import sides_filling_veins, sides_with_volume
from heartfit.heart.circulation.elements import WindkesselState
from heartfit.heart.circulation.network import ATRIA
from heartfit.heart.finite_elements.kinematics import StepFailed
from heartfit.heart.heart import Heart
from heartfit.heart.limit_cycle import Recurrence
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere import rows
from heartfit.heart.sphere.beat import State, StepInputs, advance
from heartfit.heart.sphere.body import HEALTHY_ACTIVATION, Sphere
from heartfit.heart.sphere.heart import Inertia, SphericalHeart
from heartfit.roles import COMPARTMENTS

FAILURE_REASONS = (
    "",
    "the walls and the circuit find no balance",
    "a sphere is stretched out of bounds",
    "the stiffness of a wall is zero or not finite",
    "the sarcomere equation of a fibre has no solution",
)
"""Reasons of failed steps, by outcome."""

SHIFTED_ROWS = [time + row for time in (rows.NOW, rows.BEFORE, rows.OLDER) for row in (rows.ARTERY, rows.P_C)]
"""Rows of the pressures that are shifted between beats, at all stored times."""


def simulate_spheres(
    heart: Heart,
    spheres: Sphere | Sequence[Sphere],
    numerics: Numerics | None = None,
    activation: Floats = HEALTHY_ACTIVATION,
    inertia: Inertia | None = None,
) -> Beat:
    """Beat of ``heart`` on its limit cycle, with the left ventricle, or both, as ``spheres``.

    The equations, the scheme and the approach to the limit cycle are those of a ``SphericalBody`` in ``simulate``,
    compiled as a whole. A left ventricle alone keeps the branches among its own compartments. ``activation`` (k,) are
    the activation times of the fibre classes of a sphere [s]. The tolerances of ``numerics`` are not used: a step is
    solved to 1e-5 mL and 0.01 Pa.
    """
    numerics = numerics or Numerics()
    inertia = inertia or Inertia()
    spheres = [spheres] if isinstance(spheres, Sphere) else spheres
    return simulate_spherical(
        SphericalHeart(heart, spheres, activation, inertia, numerics.second_order), numerics
    )


def simulate_spherical(heart: SphericalHeart, numerics: Numerics) -> Beat:
    """Beat of a heart of spheres on its limit cycle."""
    run, whole = SphereRun(heart, numerics), heart.heart
    try:
        return run.to_limit_cycle().beat
    except StepFailed as failure:
        return failed_beat(f"beat {run.beats + 1}: {failure}", whole.period, whole.trigger, run.diagnostics())


@dataclass(frozen=True, eq=False)
class LimitCycle:
    """The last beat of a heart, its curves as those of :func:`advance`, and the state at its end."""

    heart: SphericalHeart
    state: State
    curves: Floats
    beat: Beat


class SphereRun:
    """Beats of one heart of spheres, one after the other."""

    def __init__(self, heart: SphericalHeart, numerics: Numerics) -> None:
        self._started = clock.thread_time()
        self.heart, self.numerics, self.period = heart, numerics, heart.heart.period
        self.steps = round(self.period / numerics.time_step)
        self.beats = self.cuts = self.iterations = self.outcome = 0
        self.drift = np.inf
        length = self.period / self.steps
        self._inputs = heart.inputs(length * np.arange(float(self.steps)), length)

    def to_limit_cycle(self) -> LimitCycle:
        """The first beat below the drift, from relaxed ventricles; raises StepFailed where a step has no solution."""
        state, before = self.heart.start(), None
        curves = np.full((self.steps + 1, self._columns), np.nan)
        while True:
            first = _windkessels(state)
            self.run_beat(state, curves)
            cycle = self._recurrence(curves, first, _windkessels(state))
            self.drift = cycle.drift()
            if self.drift < self.numerics.drift or self.beats == self.numerics.max_beats:
                return self.limit_cycle(state, curves)
            responses = cycle.responses(self.heart.trees, self.period, before)
            shift_pressures(state, cycle.shifts(self.heart.trees, self.period, responses))
            before = cycle

    def run_beat(self, state: State, curves: Floats) -> None:
        """Advance the state by one beat, and replace the curves of the beat before, from which its steps start.

        The curves are NaN where there was none. Raises StepFailed where a step has no solution.
        """
        completed = self._steps(self._inputs, state, curves, 0)
        while completed < self.steps:
            length = self._inputs.length
            self._take_in_halves(state, length * completed, length, self.numerics.cuts)
            completed = self._steps(self._inputs, state, curves, completed + 1)
        self.beats += 1

    def _recurrence(
        self, curves: Floats, first: list[WindkesselState], last: list[WindkesselState]
    ) -> Recurrence:
        volumes = curves[:, : len(self.heart.spheres)].copy()  # the next beat overwrites the curves
        atria = list(self._chambers(curves).values())
        closed = bool(sides_filling_veins(self.heart.atria))
        return Recurrence(volumes, first, last, np.array(atria).reshape(-1, len(curves)).T, closed)

    @property
    def _columns(self) -> int:
        own = 4 * len(self.heart.spheres) + self.heart.fibres
        return own + len(self.heart.branches) + 2 * self._atria

    @property
    def _atria(self) -> int:
        """Number of atria among the unknowns."""
        return 0 if self.heart.atria is None else len(self.heart.spheres)

    def _chambers(self, curves: Floats) -> dict[str, Floats]:
        """Volumes (t,) of the atria that have one [m^3], by name."""
        first = 3 * len(self.heart.spheres) + len(self.heart.branches)
        return {ATRIA[s]: curves[:, first + s] for s in sides_with_volume(self.heart.atria)}

    def _steps(self, inputs: StepInputs, state: State, curves: Floats, first: int) -> int:
        completed, self.outcome, iterations = advance(self.heart.tissue, inputs, state, curves, first)
        self.iterations += iterations
        return int(completed)

    def _take_in_halves(self, state: State, start: float, length: float, cuts: int) -> None:
        """Repeat the failed step in two halves, which are halved again up to ``cuts`` times."""
        if cuts == 0:
            raise StepFailed(f"at {start:.4f} s, step {length:.2g} s: {FAILURE_REASONS[self.outcome]}")
        self.cuts, half = self.cuts + 1, 0.5 * length
        scratch = np.full((2, self._columns), np.nan)
        state.last[1] = 0.0
        for begin in (start, start + half):
            if not self._steps(self.heart.inputs(np.array([begin]), half), state, scratch, 0):
                self._take_in_halves(state, begin, half, cuts - 1)
        state.last[1] = 0.0

    def limit_cycle(self, state: State, curves: Floats) -> LimitCycle:
        """The limit cycle of this state and these curves, to whose first row the flows are added."""
        v, atria = len(self.heart.spheres), self._atrial_pressures(curves)
        flows = slice(3 * v, 3 * v + len(self.heart.branches))
        unknown = np.concatenate([curves[0, v : 3 * v], atria[: self._atria, 0]])
        curves[0, flows] = self.heart.flows(unknown, curves[0, flows])
        return LimitCycle(self.heart, state, curves, self._beat(curves, flows, atria))

    def _atrial_pressures(self, curves: Floats) -> Floats:
        """Pressures (v, t) of the atria [Pa]."""
        if self._atria:
            last = curves.shape[1] - self.heart.fibres - len(self.heart.spheres)
            return curves[:, last - self._atria : last].T
        return np.concatenate([self.heart.atria_at_start(), self._inputs.atria]).T

    def _beat(self, curves: Floats, flows: slice, atria: Floats) -> Beat:
        heart, v = self.heart.heart, len(self.heart.spheres)
        signals = [*curves[:, v : 3 * v].T, *atria]
        names = [name for side in range(3) for name in COMPARTMENTS[2 * side : 2 * side + v]]
        return Beat(
            time=np.linspace(0.0, self.period, self.steps + 1),
            volume=dict(zip(COMPARTMENTS, curves[:, :v].T, strict=False)) | self._chambers(curves),
            pressure=dict(zip(names, signals, strict=True)),
            flow=dict(zip(self.heart.branches, curves[:, flows].T, strict=True)),
            period=heart.period,
            trigger=heart.trigger,
            diagnostics=self.diagnostics() | {"wall_volume_loss": 0.0},
        )

    def diagnostics(self) -> dict[str, float]:
        """Number of beats, drift, halved steps, iterations and CPU time [s] of the run."""
        return {
            "beats": float(self.beats),
            "drift": float(self.drift),
            "step_cuts": float(self.cuts),
            "iterations": float(self.iterations),
            COST: clock.thread_time() - self._started,
        }


def _windkessels(state: State) -> list[WindkesselState]:
    return [
        WindkesselState(*held) for held in state.sides[[rows.NOW + rows.P_C, rows.NOW + rows.Q_L]].T.tolist()
    ]


def shift_pressures(state: State, shifts: Sequence[float] | Floats) -> None:
    """Shift the pressures of the arteries and of their Windkessels (v,) [Pa], at all stored times."""
    state.sides[SHIFTED_ROWS] += shifts

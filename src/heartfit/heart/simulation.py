"""Simulation of beats until the limit cycle; a failed run is a result with a reason."""

import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.heart.beat import COST, Beat, failed_beat
from heartfit.heart.circulation.atria import (
    chamber_table,
    fill_atria,
    sides_filling_veins,
    sides_with_volume,
)
from heartfit.heart.circulation.coupling import Body, Coupling, Tolerances
from heartfit.heart.circulation.network import ATRIA
from heartfit.heart.circulation.network_step import NetworkStep
from heartfit.heart.circulation.state import HeartState
from heartfit.heart.finite_elements.body import StepFailed
from heartfit.heart.finite_elements.unloading import inflate
from heartfit.heart.heart import Heart
from heartfit.heart.limit_cycle import INITIAL_RESPONSES, Recurrence
from heartfit.heart.time_step import TimeStep
from heartfit.roles import COMPARTMENTS
from heartfit.roles.chamber import VEIN_END, VOLUME

RESPONSES = "aortic_response", "pulmonary_response"
"""Keys of the measured responses among the diagnostics."""

Progress = Callable[[float], None]
Watch = Callable[[Sequence[HeartState]], None]


@dataclass(frozen=True)
class Numerics:
    """Settings of the simulation: time step [s], scheme, largest number of beats and tolerances.

    A beat is periodic if its drift, see :meth:`Recurrence.drift`, is below ``drift``. A step that fails is halved up
    to ``cuts`` times.
    """

    time_step: float = 5e-3
    second_order: bool = True
    max_beats: int = 6
    drift: float = 0.01
    cuts: int = 5
    keep_positions: bool = False
    tolerances: Tolerances = field(default_factory=Tolerances)


def simulate(
    heart: Heart,
    body: Body,
    numerics: Numerics | None = None,
    progress: Progress | None = None,
    watch: Watch | None = None,
    start: HeartState | None = None,
    responses: Sequence[float] = INITIAL_RESPONSES,
) -> Beat:
    """Beat of ``heart`` with the ventricles ``body`` on its limit cycle.

    Between beats the pressures of the Windkessels are shifted towards their periodic values, see
    :meth:`Recurrence.shifts`. The last beat is periodic if its own drift, which the diagnostics state, is below that of
    ``numerics``. A run that fails returns a failed beat with the reason. ``progress`` is called after every time step
    with the completed fraction of ``max_beats``, ``watch`` once with the states of the last beat, one per time. Beats
    begin at ``start``, a state of the body near the limit cycle, or without one at relaxed ventricles, filled at the
    resting atrial pressures. ``responses`` guesses the :meth:`Recurrence.responses`; the diagnostics hold the measured
    ones, with which a similar heart takes fewer beats. Raises InputError unless the body is made of ``heart.muscle``.
    """
    _require_muscle(heart, body)
    run = _Run(heart, body, numerics or Numerics(), progress, watch, responses)
    try:
        return run.to_limit_cycle(run.relaxed() if start is None else start)
    except StepFailed as failure:
        return failed_beat(f"beat {run.beats + 1}: {failure}", heart.period, heart.trigger, run.diagnostics())


def _require_muscle(heart: Heart, body: Body) -> None:
    """Raise InputError if mechanisms of the heart act on the tissue and the body is not made of the result."""
    if heart.muscle not in (heart.tissue, body.tissue):
        raise InputError(
            "simulate: the body lacks mechanisms of the heart in its tissue; make it of heart.muscle"
        )


def _ignore(_: object) -> None:
    """No-op callback."""


class _Run:
    def __init__(
        self,
        heart: Heart,
        body: Body,
        numerics: Numerics,
        progress: Progress | None,
        watch: Watch | None,
        responses: Sequence[float],
    ) -> None:
        self.heart, self.body, self.numerics = heart, body, numerics
        self.coupling = Coupling(body, heart.circulation, heart.mechanisms, numerics.tolerances)
        self.steps = round(heart.period / numerics.time_step)
        self.atria = chamber_table(heart.mechanisms)
        self.progress, self.watch = progress or _ignore, watch or _ignore
        self.beats, self.cuts, self.drift = 0, 0, np.inf
        self.guesses = self.responses = list(responses)
        self._started = clock.process_time()

    def to_limit_cycle(self, state: HeartState) -> Beat:
        before, trees = None, self.heart.circulation.trees()
        changes: list[Floats] = []  # of the unknowns, in the steps of the beat before
        while True:
            history = [state]
            for n in range(self.steps):
                expected = state.body.x + changes[n] if changes else None
                state = self._advance(state, self._step(n, state), self.numerics.cuts, expected)
                history.append(state)
                self.progress((self.beats + (n + 1) / self.steps) / self.numerics.max_beats)
            self.beats += 1
            cycle = self._recurrence(history)
            self.drift = cycle.drift()
            periodic = self.drift < self.numerics.drift or self.beats == self.numerics.max_beats
            if self.beats == 2 or not periodic:  # the last of more beats rises too little to measure
                self.responses = cycle.responses(trees, self.heart.period, before, self.guesses)
            if periodic:
                self.watch(history)
                return self._beat(history)
            state = state.shift_pressures(cycle.shifts(trees, self.heart.period, self.responses))
            before = cycle
            changes = [end.body.x - start.body.x for start, end in pairwise(history)]

    def _recurrence(self, history: list[HeartState]) -> Recurrence:
        volumes = np.array([state.volumes for state in history])
        trees = history[0].trees, history[-1].trees
        return Recurrence(
            volumes, *trees, self._atrial_volumes(history), bool(sides_filling_veins(self.atria))
        )

    def _atrial_volumes(self, history: list[HeartState]) -> Floats:
        """Volumes (t, c) of the atria that have one [m^3]."""
        sides = sides_with_volume(self.atria)
        volumes: Floats = np.array([[state.atria[0, s] for s in sides] for state in history])  # type: ignore[index]
        return volumes

    @property
    def dt(self) -> float:
        return self.heart.period / self.steps

    def relaxed(self) -> HeartState:
        """State of relaxed ventricles, filled at the resting atrial pressures."""
        trees = self.heart.circulation.start(self.heart.period)
        atria = self.heart.circulation.atrial(self.heart.period, self.heart.period, ())
        pressures = np.array([*atria, *(tree.P_c for tree in trees)])
        filled = inflate(self.body, atria)
        volumes = self.body.volumes(filled.x)
        if self.atria is None:
            return HeartState(filled, pressures, volumes, trees)
        table = self.atria.copy()
        fill_atria(table, atria, volumes)
        start = table[[VOLUME, VEIN_END]]
        return HeartState(filled, np.append(pressures, atria), volumes, trees, atria=start)

    def _step(self, n: int, state: HeartState) -> TimeStep:
        return TimeStep(n * self.dt, self.dt, self.heart.period, self.numerics.second_order, state.last)

    def _advance(
        self, state: HeartState, step: TimeStep, cuts: int, expected: Floats | None = None
    ) -> HeartState:
        try:
            return self.coupling.advance(state, step, expected)
        except StepFailed as failure:
            if cuts == 0:
                raise StepFailed(f"at {step.start:.4f} s, step {step.length:.2g} s: {failure}") from failure
        self.cuts += 1
        half = self._advance(replace(state, trend=()), step.half(second=False), cuts - 1)
        return self._advance(half, replace(step.half(second=True), last=half.last), cuts - 1)

    def _beat(self, history: list[HeartState]) -> Beat:
        time = np.linspace(0.0, self.heart.period, self.steps + 1)
        volumes = np.array([state.volumes for state in history])
        pressure, flow = self._signals(time, history)
        return Beat(
            time=time,
            volume={"lv": volumes[:, 0], "rv": volumes[:, 1]} | self._chambers(history),
            pressure=pressure,
            flow=flow,
            period=self.heart.period,
            trigger=self.heart.trigger,
            diagnostics=self.diagnostics() | self._wall(history),
            positions=self._positions(history),
        )

    def _chambers(self, history: list[HeartState]) -> dict[str, Floats]:
        names = [ATRIA[s] for s in sides_with_volume(self.atria)]
        return dict(zip(names, self._atrial_volumes(history).T, strict=True))

    def _signals(
        self, time: Floats, history: list[HeartState]
    ) -> tuple[dict[str, Floats], dict[str, Floats]]:
        pressures, flows = [], []
        for t, state in zip(time, history, strict=True):
            network = NetworkStep(self.coupling.network, t, self.dt, self.heart.period)
            pressures.append([*state.pressures, *network.atrial][: len(COMPARTMENTS)])
            flows.append(network.flows(state.pressures, state.branches))
        pressure = dict(zip(COMPARTMENTS, np.array(pressures).T, strict=True))
        return pressure, {name: np.array([row[name] for row in flows]) for name in flows[0]}

    def _positions(self, history: list[HeartState]) -> Floats | None:
        if not self.numerics.keep_positions:
            return None
        return np.array([self.body.positions(state.body.x) for state in history])  # type: ignore[attr-defined]

    def _wall(self, history: list[HeartState]) -> dict[str, float]:
        walls = np.array(
            [self.body.wall_volume(state.body.x) for state in history[:: max(1, self.steps // 40)]]
        )
        return {"wall_volume_loss": float(1.0 - walls.min() / walls.max())}

    def diagnostics(self) -> dict[str, float]:
        """Beats, drift, halved steps, iterations, factorisations, measured responses and CPU time [s] of the run."""
        return {
            "beats": float(self.beats),
            "drift": float(self.drift),
            "step_cuts": float(self.cuts),
            "iterations": float(self.coupling.iterations),
            "factorisations": float(self.coupling.factorisations),
            **dict(zip(RESPONSES, self.responses, strict=True)),
            COST: clock.process_time() - self._started,
        }

"""Run beats until the limit cycle; a run that fails is a result with a reason."""

import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from heartfit.beat import COST, Beat, failed_beat
from heartfit.circulation.coupling import Body, Coupling, HeartState, Tolerances
from heartfit.circulation.network import NetworkStep
from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.heart import Heart
from heartfit.limit_cycle import Recurrence
from heartfit.mechanics.body import StepFailed
from heartfit.mechanics.statics import inflate
from heartfit.mechanics.time_step import TimeStep
from heartfit.mechanism import COMPARTMENTS

Progress = Callable[[float], None]
Watch = Callable[[Sequence[HeartState]], None]


@dataclass(frozen=True)
class Numerics:
    """Time step, s, limits of the beats, and what counts as a limit cycle.

    ``drift`` is the largest change of a cavity volume (over stroke volume) and of an arterial pressure (over
    itself) from the start of a beat to its end. ``cuts`` is how often a step may be halved.
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
) -> Beat:
    """Beat of ``heart`` with the ventricles ``body`` on its limit cycle.

    Between beats the pressures of the Windkessels, whose memory of tau is longer than a beat, are shifted
    towards where the stroke volume of the last beat would hold them. A beat counts as periodic by its own
    drift, from start to end, which is stated. The body is made of ``heart.muscle``; raises InputError where it lacks
    a mechanism.
    ``progress`` is called with the fraction done of ``max_beats`` after every time step, ``watch`` once with the
    states of the beat, one for each time.
    """
    _require_muscle(heart, body)
    run = _Run(heart, body, numerics or Numerics(), progress, watch)
    try:
        return run.to_limit_cycle()
    except StepFailed as failure:
        return failed_beat(f"beat {run.beats + 1}: {failure}", heart.period, heart.trigger, run.diagnostics())


def _require_muscle(heart: Heart, body: Body) -> None:
    """Raise InputError when mechanisms of the heart are to act on a muscle that the body is not made of."""
    if heart.muscle not in (heart.tissue, body.tissue):
        raise InputError("simulate: the ventricles lack mechanisms of the heart; make them of heart.muscle")


def _silence(_: object) -> None:
    """What nobody watches."""


class _Run:
    def __init__(
        self, heart: Heart, body: Body, numerics: Numerics, progress: Progress | None, watch: Watch | None
    ) -> None:
        self.heart, self.body, self.numerics = heart, body, numerics
        self.coupling = Coupling(body, heart.circulation, heart.mechanisms, numerics.tolerances)
        self.steps = round(heart.period / numerics.time_step)
        self.progress, self.watch = progress or _silence, watch or _silence
        self.beats, self.cuts, self.drift = 0, 0, np.inf
        self._started = clock.process_time()

    def to_limit_cycle(self) -> Beat:
        state = self._start()
        before: Recurrence | None = None
        while True:
            history = [state]
            for n in range(self.steps):
                state = self._advance(state, self._step(n, state), self.numerics.cuts)
                history.append(state)
                self.progress((self.beats + (n + 1) / self.steps) / self.numerics.max_beats)
            self.beats += 1
            cycle = Recurrence(
                np.array([each.volumes for each in history]), history[0].trees, history[-1].trees
            )
            self.drift = cycle.drift()
            if self.drift < self.numerics.drift or self.beats == self.numerics.max_beats:
                self.watch(history)
                return self._beat(history)
            state = state.raised(cycle.shifts(self.heart.circulation.trees(), self.heart.period, before))
            before = cycle

    @property
    def dt(self) -> float:
        return self.heart.period / self.steps

    def _start(self) -> HeartState:
        """Relaxed ventricles filled at the resting atrial pressures."""
        trees = self.heart.circulation.start(self.heart.period)
        atria = self.heart.circulation.atrial(self.heart.period, self.heart.period, ())
        pressures = np.array([*atria, *(tree.P_c for tree in trees)])
        filled = inflate(self.body, atria)
        return HeartState(filled, pressures, self.body.volumes(filled.x), trees)

    def _step(self, n: int, state: HeartState) -> TimeStep:
        return TimeStep(n * self.dt, self.dt, self.heart.period, self.numerics.second_order, state.last)

    def _advance(self, state: HeartState, step: TimeStep, cuts: int) -> HeartState:
        try:
            return self.coupling.advance(state, step)
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
            volume={"lv": volumes[:, 0], "rv": volumes[:, 1]},
            pressure=pressure,
            flow=flow,
            period=self.heart.period,
            trigger=self.heart.trigger,
            diagnostics=self.diagnostics() | self._wall(history),
            positions=self._positions(history),
        )

    def _signals(
        self, time: Floats, history: list[HeartState]
    ) -> tuple[dict[str, Floats], dict[str, Floats]]:
        pressures, flows = [], []
        for t, state in zip(time, history, strict=True):
            network = NetworkStep(
                self.heart.circulation, self.heart.mechanisms, t, self.dt, self.heart.period
            )
            pressures.append([*state.pressures, *network.atrial])
            flows.append(network.flows(state.pressures))
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
        """What the run cost and how periodic it became."""
        return {
            "beats": float(self.beats),
            "drift": float(self.drift),
            "step_cuts": float(self.cuts),
            "iterations": float(self.coupling.iterations),
            "factorisations": float(self.coupling.factorisations),
            COST: clock.process_time() - self._started,
        }

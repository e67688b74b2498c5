r"""Tangent-linear beats: derivatives of a whole beat by many coordinates of a heart at once.

Every column is a neighbour of the heart, h away along one coordinate, that takes each time step together with it. Let K
be the factorised tangent of the step at the solution y of the heart. The neighbour of the residual R starts at y plus
its difference at the step before, and one Newton correction with the K of the heart,

.. math:: z = z_0 - K^{-1} R(z_0), \qquad z_0 = y_{n+1} + (z_n - y_n),

leaves an error of the order of :math:`h^2`: a step of all columns takes one factorisation, one evaluation of the forces
for each column and one substitution for all of them.

**Limit cycle.** A beat maps the difference d at its start to :math:`d' = A d + b` at its end, and shows the curves
:math:`H d + g`. From two beats the images :math:`A (d' - d)` and :math:`H (d' - d)` are known for as many directions as
there are columns; two columns of their own start with a higher pressure in one Windkessel, the slowest coordinates.
What is missing to the difference :math:`d^*` that a beat reproduces, :math:`r = A d' + b - d'`, is sought among them,

.. math:: (I - A) \sum_i c_i (d'_i - d_i) = r, \qquad H d^* + g = H d' + g + \sum_i c_i H (d'_i - d_i),

by least squares in the slow coordinates: volumes and pressures of the circulation, and the place of the heart on its
dampers. The shape of the wall follows them within a beat.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.heart.beat import Beat
from heartfit.heart.circulation.atria import chamber_table, sides_with_volume
from heartfit.heart.circulation.coupling import Coupling
from heartfit.heart.circulation.state import HeartState
from heartfit.heart.finite_elements.body import FiniteElementBody, StepFailed
from heartfit.heart.finite_elements.neighbours import carry_state
from heartfit.heart.heart import Heart
from heartfit.heart.neighbourhood import Neighbour
from heartfit.heart.simulation import Numerics, simulate
from heartfit.heart.time_step import TimeStep
from heartfit.roles import COMPARTMENTS

TANGENT_STEP = 10e-3
"""Time step [s] that suffices for derivatives, which need fewer digits than predictions."""
PRESSURE_SIZE = 0.01
"""Relative rise of the pressure of a Windkessel in the columns that show the response to it."""
ONE_CENTIMETRE = 0.01
SLOW_TOLERANCE = 1e-6
"""Smallest singular value that counts, over the largest, among the directions of the slow coordinates."""


@dataclass(frozen=True, eq=False)
class TangentBeat:
    """A periodic beat, and its derivatives by the coordinates of its neighbours.

    ``signals`` holds the derivatives (t, k) of volumes [m^3], pressures [Pa] and flows [m^3/s] by k coordinates, by the
    names of :meth:`Beat.signals`; ``positions`` (k, t, n, 3) those of the nodes [m], in single precision.
    """

    beat: Beat
    neighbours: tuple[Neighbour, ...]
    signals: Mapping[str, Floats]
    positions: np.ndarray

    def near(self, column: int, size: float | None = None) -> Beat:
        """Beat at the distance ``size`` along a coordinate, by default that of the neighbour, to first order."""
        h = self.neighbours[column].size if size is None else size
        beat, trigger = self.beat, self.neighbours[column].heart.trigger
        groups = (beat.volume, "volume"), (beat.pressure, "pressure"), (beat.flow, "flow")
        volume, pressure, flow = (self._shifted(group, kind, h, column) for group, kind in groups)
        positions = np.asarray(beat.positions) + h * self.positions[column]
        return replace(
            beat, volume=volume, pressure=pressure, flow=flow, positions=positions, trigger=trigger
        )

    def _shifted(self, group: Mapping[str, Floats], kind: str, h: float, column: int) -> dict[str, Floats]:
        """Curves of one kind, by name; a pressure that is prescribed has no derivative."""
        return {
            name: values + h * self.signals[f"{name}_{kind}"][:, column]
            if f"{name}_{kind}" in self.signals
            else values
            for name, values in group.items()
        }


def tangent_numerics(numerics: Numerics) -> Numerics:
    """The numerics with a time step of at least TANGENT_STEP."""
    return replace(numerics, time_step=max(TANGENT_STEP, numerics.time_step))


def differentiate(
    heart: Heart, body: FiniteElementBody, neighbours: Sequence[Neighbour], numerics: Numerics | None = None
) -> TangentBeat:
    """Beat of ``heart`` on its limit cycle, and its derivatives by the coordinates of the ``neighbours``.

    The coordinates should have sizes under which the beat is linear, about a hundredth of a standard deviation. The
    limit cycle is that of `simulate` for the ``numerics``. Raises StepFailed where a step has no solution even if it is
    halved, InputError where the beat fails, or where a neighbour has other atria or another period.
    """
    for number, neighbour in enumerate(neighbours):
        _require_alike(heart, neighbour.heart, number)
    chosen = replace(numerics or Numerics(), keep_positions=True)
    history: list[HeartState] = []
    beat = simulate(heart, body, chosen, watch=history.extend)
    if not beat.completed:
        raise InputError(f"tangent: {beat.reason}; expected a beat to differentiate")
    run = _Lockstep(heart, body, neighbours, chosen, history[-1])
    first, last = run.beat(), run.beat()
    weights, k = last.continuation(first), len(neighbours)
    signals = last.signals + (last.signals - first.signals) @ weights
    change = (last.positions - first.positions).reshape(len(weights), -1)
    last.positions += (weights.T.astype(np.float32) @ change).reshape(last.positions.shape)
    by_name = dict(zip(run.names, signals[..., :k].swapaxes(0, 1), strict=True))
    return TangentBeat(beat, tuple(neighbours), by_name, last.positions[:k])


def _require_alike(heart: Heart, other: Heart, number: int) -> None:
    """Raise InputError for a neighbour that another equation describes."""
    if other.period != heart.period:
        raise InputError(
            f"tangent: neighbour {number} beats in {other.period:g} s; expected {heart.period:g} s"
        )
    own, others = (sides_with_volume(chamber_table(one.mechanisms)) for one in (heart, other))
    if own != others:
        raise InputError(
            f"tangent: neighbour {number} has {len(others)} atria with a volume; expected {len(own)}, as its heart"
        )


@dataclass(eq=False)
class _Differences:
    """Differences of one beat of k columns over their sizes.

    ``signals`` (t, s, k), ``positions`` (k, t, n, 3), and ``slow`` (2, r, k): the slow coordinates at start and
    end.
    """

    signals: Floats
    positions: np.ndarray
    slow: Floats

    def continuation(self, before: "_Differences") -> Floats:
        """Weights (k, k) of the differences from the beat ``before`` that lead this one to the limit cycle."""
        start, end = self.slow - before.slow
        missing = self.slow[1] - self.slow[0]
        weights: Floats = np.linalg.lstsq(start - end, missing, rcond=SLOW_TOLERANCE)[0]
        return weights


class _Lockstep:
    """Beats of a heart and of its neighbours, from the state ``start`` of the heart on its limit cycle.

    The first state is that of the heart, the next one that of the heart again, as a column without any difference: what
    a single correction leaves is common to all columns, and their differences from that one are free of it. The last
    two columns are the heart with a higher pressure in one Windkessel at the start.
    """

    def __init__(
        self,
        heart: Heart,
        body: FiniteElementBody,
        neighbours: Sequence[Neighbour],
        numerics: Numerics,
        start: HeartState,
    ) -> None:
        self.heart, self.body, self.numerics = heart, body, numerics
        self.steps = round(heart.period / numerics.time_step)
        own = Neighbour(heart, body, PRESSURE_SIZE)
        members = [own, *neighbours, own, own]
        self.couplings = [_coupling(member.heart, member.body, numerics) for member in members]
        self.coupling = _coupling(heart, body, numerics)
        self.sizes = np.array([member.size for member in members[1:]])
        self.bodies = [member.body for member in members]
        _share(self.bodies, "control_means")
        _share(self.couplings, "network")
        raised = [start.shift_pressures(shift) for shift in PRESSURE_SIZE * np.diag(_tree_pressures(start))]
        carried = [
            start.with_walls(partial(carry_state, body=body, other=member.body)) for member in neighbours
        ]
        self.states = [start, start, *carried, *raised]
        flows = [coupling.network.names for coupling in self.couplings]
        self.flows = [[names.index(name) for name in flows[0]] for names in flows]
        volumes, pressures = ("lv", "rv"), COMPARTMENTS[: len(start.pressures)]
        self.names = [
            *(f"{name}_volume" for name in volumes),
            *(f"{name}_pressure" for name in pressures),
            *(f"{name}_flow" for name in flows[0]),
        ]

    def beat(self) -> _Differences:
        """Differences during the next beat."""
        signals, positions = [], []
        dt, period = self.heart.period / self.steps, self.heart.period
        slow = [self._slow()]
        for n in range(self.steps + 1):
            if n:
                step = TimeStep((n - 1) * dt, dt, period, self.numerics.second_order, self.states[0].last)
                self.states = self._advance(self.states, step, self.numerics.cuts)
            signals.append(self._differences(self._signals()))
            positions.append(self._positions())
        slow.append(self._slow())
        return _Differences(np.array(signals), np.stack(positions, axis=1), np.array(slow))

    def _advance(self, states: list[HeartState], step: TimeStep, cuts: int) -> list[HeartState]:
        try:
            return self._step(states, step)
        except StepFailed:
            if cuts == 0:
                raise
        half = self._advance(
            [replace(state, trend=()) for state in states], step.half(second=False), cuts - 1
        )
        return self._advance(half, replace(step.half(second=True), last=half[0].last), cuts - 1)

    def _step(self, states: list[HeartState], step: TimeStep) -> list[HeartState]:
        state, *others = states
        coupled, now, factor, response = self.coupling.linearise(state, step)
        equations = [
            coupling.equations(other, step) for coupling, other in zip(self.couplings, others, strict=True)
        ]
        for own in equations:
            own.step.wall.start_near(coupled.step.wall)
        trials = [
            own.at(now.x + (other.body.x - state.body.x), now.pressures + (other.pressures - state.pressures))
            for own, other in zip(equations, others, strict=True)
        ]
        changes = -factor.solve(np.column_stack([trial.residual for trial in trials]))
        return [
            coupled.commit(now),
            *(
                own.commit(own.follow(trial, *own.balance(trial, change, response)))
                for own, trial, change in zip(equations, trials, changes.T, strict=True)
            ),
        ]

    def _signals(self) -> Floats:
        """Volumes, pressures and flows (s, 1 + k) of all columns."""
        return np.column_stack(
            [
                np.concatenate([state.volumes, state.pressures, np.asarray(state.branches)[0, flows]])
                for state, flows in zip(self.states[1:], self.flows, strict=True)
            ]
        )

    def _differences(self, table: Floats) -> Floats:
        """Columns of a table (s, 1 + k) less the first one, over the sizes (s, k)."""
        result: Floats = (table[:, 1:] - table[:, :1]) / self.sizes
        return result

    def _positions(self) -> np.ndarray:
        """Derivatives (k, n, 3) of the positions of the nodes."""
        own, *others = (
            body.positions(state.body.x) for state, body in zip(self.states[1:], self.bodies, strict=True)
        )
        columns = zip(others, self.sizes, strict=True)
        return np.array([(position - own) / size for position, size in columns], dtype=np.float32)

    def _slow(self) -> Floats:
        """Differences (r, k) of the slow coordinates: first the pressures of the Windkessels, in the unit of each."""
        slow = np.column_stack([_slow_coordinates(state) for state in self.states[1:]])
        units = np.abs(slow[:, :1])
        units[-3:] = ONE_CENTIMETRE
        return self._differences(slow / units)


def _tree_pressures(state: HeartState) -> Floats:
    return np.array([tree.P_c for tree in state.trees])


def _slow_coordinates(state: HeartState) -> Floats:
    """Pressures of the Windkessels, volumes, other pressures, and the mean displacement (3,), which is last."""
    atria = np.empty(0) if state.atria is None else state.atria[0]
    displacement = state.body.x[:, :3].mean(axis=0)
    return np.concatenate([_tree_pressures(state), state.volumes, atria, state.pressures, displacement])


def _share(owners: Sequence[FiniteElementBody] | Sequence[Coupling], name: str) -> None:
    """Let owners whose parts of a ``name`` are equal share one, which computes its values of each step once."""
    different: list[Any] = []
    for owner in owners:
        part = getattr(owner, name)
        equal = next((other for other in different if other.equals(part)), None)
        if equal is None:
            different.append(part)
        else:
            setattr(owner, name, equal)


def _coupling(heart: Heart, body: FiniteElementBody, numerics: Numerics) -> Coupling:
    return Coupling(body, heart.circulation, heart.mechanisms, numerics.tolerances)

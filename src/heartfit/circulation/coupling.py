r"""One time step of wall and circuit together.

Unknowns are the body's x and the pressures of ventricles and arteries. Newton's method on

.. math:: f(x) - \sum_c P_c \nabla V_c(x) = 0, \quad V_c(x) - V_c^* + w \sum q = 0, \quad
          P_a = a + b \sum q

(w and the shifted value are those of :mod:`heartfit.mechanics.time_step`)
with a factorisation of :math:`\partial f/\partial x` that is kept over many steps. In every iteration the
body is condensed to its compliance :math:`\nabla V^T K^{-1} \nabla V`, and the small circuit is solved to the
end, so that the kinks of the valves never reach the large system.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np

from heartfit.circulation.circuit import Circuit
from heartfit.circulation.enclosure import Enclosed
from heartfit.circulation.network import Circulation, NetworkStep
from heartfit.circulation.windkessel import WindkesselState
from heartfit.geometry.arrays import Floats
from heartfit.mechanics.acceleration import Anderson
from heartfit.mechanics.body import StepFailed
from heartfit.mechanics.time_step import TimeStep
from heartfit.mechanics.tissue import Tissue
from heartfit.mechanism import External, Mechanism

EXTRAPOLATION: tuple[tuple[float, ...], ...] = ((), (1.0,), (2.0, -1.0))
"""Weights of the known velocities in the predicted one."""

HALVINGS = 6
"""How often a Newton step may be halved before the time step is given up."""

PRESSURE_WEIGHT = 1e-4
"""Weight of a cavity pressure, 1/Pa, beside the body's weights in the mixing of changes."""


class Body(Protocol):
    """A pair of ventricles: finite elements, or two spheres of the same law."""

    @property
    def tissue(self) -> Tissue: ...
    def rest(self) -> Any: ...
    def volumes(self, x: Floats) -> Floats: ...
    def volume_gradients(self, x: Floats) -> Floats: ...
    def step(self, state: Any, step: TimeStep) -> Any: ...
    def wall_volume(self, x: Floats) -> float: ...


@dataclass(frozen=True)
class Tolerances:
    """When a step has converged, and when the factorisation is renewed."""

    force: float = 4e-2  # N
    volume: float = 1e-10  # m^3
    pressure: float = 1.0  # Pa, of the arteries
    iterations: int = 25
    contraction: float = 0.8


@dataclass(frozen=True, eq=False)
class HeartState:
    """State of wall and circuit at one time; ``before`` is that one step of length ``last`` earlier.

    ``trend`` holds the last velocity of x and the one before.
    """

    body: Any
    pressures: Floats
    volumes: Floats
    trees: tuple[WindkesselState, WindkesselState]
    trend: tuple[Floats, ...] = ()
    last: float | None = None
    before: "HeartState | None" = None

    def shifted(self, step: TimeStep) -> tuple[Floats, tuple[WindkesselState, WindkesselState]]:
        """Volumes and Windkessels from which the effective step starts."""
        before = self.before or self
        systemic, pulmonary = (
            WindkesselState(step.shifted(now.P_c, then.P_c), step.shifted(now.q_L, then.q_L))
            for now, then in zip(self.trees, before.trees, strict=True)
        )
        return step.shifted(self.volumes, before.volumes), (systemic, pulmonary)

    def raised(self, shifts: Sequence[float]) -> "HeartState":
        """The state with the pressures of both Windkessels raised by ``shifts``, Pa, now and before."""
        systemic, pulmonary = (
            replace(tree, P_c=tree.P_c + shift) for tree, shift in zip(self.trees, shifts, strict=True)
        )
        pressures = self.pressures + np.array([0.0, 0.0, *shifts])
        before = self.before and self.before.raised(shifts)
        return replace(self, trees=(systemic, pulmonary), pressures=pressures, before=before)


@dataclass(frozen=True, eq=False)
class Iterate:
    """A trial state: unknowns, their forces (N,), pressures (4,), volumes (2,) and their gradients (N, 2)."""

    x: Floats
    forces: Floats
    pressures: Floats
    volumes: Floats
    gradients: Floats

    @property
    def residual(self) -> Floats:
        """Imbalance (N,) of wall and cavity pressures."""
        result: Floats = self.forces - self.gradients @ self.pressures[:2]
        return result


class CoupledStep:
    """The equations of one step of wall and circuit."""

    def __init__(
        self, body: Any, step: Any, network: NetworkStep, time_step: TimeStep, state: HeartState
    ) -> None:
        self._body, self.step, self._network, self._state = body, step, network, state
        self._time_step = time_step
        self._volumes, self._trees = state.shifted(time_step)
        self._windkessels = network.windkessels(self._trees)

    def predict(self) -> Iterate:
        """First guess by extrapolation; the old state where that is not admissible."""
        state, dt = self._state, self._time_step.length
        known = zip(EXTRAPOLATION[len(state.trend)], state.trend, strict=True)
        velocity = sum((weight * past for weight, past in known), np.zeros_like(state.body.x))
        try:
            return self._at(state.body.x + dt * velocity, state.pressures)
        except StepFailed:
            return self._at(state.body.x, state.pressures)

    def _at(self, x: Floats, pressures: Floats) -> Iterate:
        forces = self.step.forces(x)
        return Iterate(x, forces, pressures, self._body.volumes(x), self._body.volume_gradients(x))

    def gaps(self, now: Iterate) -> Floats:
        """What is missing in the balances of the ventricles, m^3, and of the arteries, Pa; (4,)."""
        return self._circuit(now, np.zeros_like(now.residual), np.zeros_like(now.gradients)).gaps(
            now.pressures
        )

    def pressures(self, now: Iterate, change: Floats, response: Floats) -> Floats:
        """Pressures that balance the circuit, the body being linear about ``now`` plus ``change``."""
        return self._circuit(now, change, response).solve()

    def _circuit(self, now: Iterate, change: Floats, response: Floats) -> Circuit:
        volumes = now.volumes + now.gradients.T @ change - self._volumes
        compliance = now.gradients.T @ response
        return Circuit(self._network, self._windkessels, volumes, compliance, now.pressures)

    def move(self, now: Iterate, change: Floats, pressures: Floats) -> Iterate:
        """The iterate after ``change``, which is halved until no element collapses."""
        for halving in range(HALVINGS):
            try:
                return self._at(now.x + 0.5**halving * change.reshape(now.x.shape), pressures)
            except StepFailed:
                continue
        raise StepFailed("no admissible Newton step: elements collapse")

    def commit(self, now: Iterate) -> HeartState:
        """State at the end of the step; the Windkessels take the very blood that left the ventricles."""
        state, length = self._state, self._time_step.length
        trees = self._network.advance(self._trees, now.pressures)
        trend = ((now.x - state.body.x) / length, *state.trend[:1])
        before = replace(state, before=None)
        return HeartState(self.step.commit(now.x), now.pressures, now.volumes, trees, trend, length, before)


class Coupling:
    """Advances body and circuit; owns the factorisation that the steps share."""

    def __init__(
        self, body: Body, circulation: Circulation, mechanisms: Sequence[Mechanism], tolerances: Tolerances
    ) -> None:
        self.circulation, self.mechanisms = circulation, mechanisms
        loaded = any(isinstance(m, External) for m in mechanisms)
        self.body = Enclosed(body, mechanisms) if loaded else body
        self.tolerances = tolerances
        self.iterations = self.factorisations = 0
        self._factor: Any = None
        self._response = np.empty((0, 2))
        self._length = 0.0

    def advance(self, state: HeartState, step: TimeStep) -> HeartState:
        """State after ``step``; raises StepFailed if Newton's method does not get there."""
        equations = self.body.step(state.body, step)
        network = NetworkStep(self.circulation, self.mechanisms, step.end, step.effective, step.period)
        if step.effective != self._length:
            self._factor, self._length = None, step.effective
        coupled = CoupledStep(self.body, equations, network, step, state)
        return coupled.commit(self._newton(coupled))

    def _newton(self, coupled: CoupledStep) -> Iterate:
        now, previous, fresh = coupled.predict(), np.inf, False
        anderson = Anderson(np.append(coupled.step.weights(now.x), np.full(4, PRESSURE_WEIGHT)))
        for _ in range(self.tolerances.iterations):
            size = coupled.step.size(now.residual)
            if size < self.tolerances.force and self._balanced(coupled.gaps(now)):
                return now
            stale = not fresh and size > self.tolerances.contraction * previous
            fresh, previous = self._factor is None or stale, size
            if fresh:
                self._renew(coupled.step, now)
                anderson.forget()
            now = self._iterate(coupled, now, anderson)
            self.iterations += 1
        raise StepFailed(f"no equilibrium in {self.tolerances.iterations} iterations, residual {size:.3g} N")

    def _balanced(self, gaps: Floats) -> bool:
        volume, pressure = np.abs(gaps[:2]).max(), np.abs(gaps[2:]).max()
        return bool(volume < self.tolerances.volume and pressure < self.tolerances.pressure)

    def _renew(self, step: Any, now: Iterate) -> None:
        self._factor = step.tangent(now.x)
        self._response = self._factor.solve(now.gradients)
        self.factorisations += 1

    def _iterate(self, coupled: CoupledStep, now: Iterate, anderson: Anderson) -> Iterate:
        change = -self._factor.solve(now.residual)
        pressures = coupled.pressures(now, change, self._response)
        change += self._response @ (pressures - now.pressures)[:2]
        mixed = anderson.mix(np.append(now.x, now.pressures), np.append(change, pressures - now.pressures))
        return coupled.move(now, mixed[:-4], now.pressures + mixed[-4:])

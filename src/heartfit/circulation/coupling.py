r"""One time step of wall and circuit together.

Unknowns are the body's x and the pressures of ventricles and arteries. Newton's method on

.. math:: f(x) - \sum_c P_c \nabla V_c(x) = 0, \quad V_c(x) - V_c^n + \Delta t \sum q = 0, \quad
          P_a = a + b \sum q

with a factorisation of :math:`\partial f/\partial x` that is kept over many steps. In every iteration the body
is condensed to its compliance :math:`\nabla V^T K^{-1} \nabla V`, and the small circuit is solved to the end,
so that the kinks of the valves never reach the large system.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from heartfit.circulation.circuit import Circuit
from heartfit.circulation.network import Circulation, NetworkStep
from heartfit.circulation.windkessel import WindkesselState
from heartfit.geometry.arrays import Floats
from heartfit.mechanics.acceleration import Anderson
from heartfit.mechanics.body import StepFailed
from heartfit.mechanism import Mechanism


EXTRAPOLATION: tuple[tuple[float, ...], ...] = ((), (1.0,), (2.0, -1.0))
"""Weights of the known velocities in the predicted one."""

PRESSURE_WEIGHT = 1e-4
"""Weight of a cavity pressure, 1/Pa, beside the body's weights in the mixing of changes."""


class Body(Protocol):
    """A pair of ventricles: finite elements, or two spheres of the same law."""

    def rest(self) -> Any: ...
    def volumes(self, x: Floats) -> Floats: ...
    def volume_gradients(self, x: Floats) -> Floats: ...
    def step(self, state: Any, start: float, dt: float, period: float) -> Any: ...
    def wall_volume(self, x: Floats) -> float: ...


@dataclass(frozen=True)
class Tolerances:
    """When a step has converged, and when the factorisation is renewed."""

    force: float = 5e-3  # N
    volume: float = 1e-10  # m^3
    iterations: int = 25
    contraction: float = 0.6


@dataclass(frozen=True, eq=False)
class HeartState:
    """State of wall and circuit at one time; ``trend`` holds the last velocity of x and the one before."""

    body: Any
    pressures: Floats
    volumes: Floats
    trees: tuple[WindkesselState, WindkesselState]
    trend: tuple[Floats, ...] = ()


class Coupling:
    """Advances body and circuit; owns the factorisation that the steps share."""

    def __init__(
        self, body: Body, circulation: Circulation, mechanisms: Sequence[Mechanism], tolerances: Tolerances
    ) -> None:
        self.body, self.circulation, self.mechanisms = body, circulation, mechanisms
        self.tolerances = tolerances
        self.iterations = self.factorisations = 0
        self._factor: Any = None
        self._response = np.empty((0, 2))
        self._dt = 0.0

    def advance(self, state: HeartState, start: float, dt: float, period: float) -> HeartState:
        """State after the step of length ``dt``; raises StepFailed if Newton's method does not get there."""
        step = self.body.step(state.body, start, dt, period)
        network = NetworkStep(self.circulation, self.mechanisms, start + dt, dt, period)
        if dt != self._dt:
            self._factor, self._dt = None, dt
        x, pressures = self._newton(step, network, state)
        return self._commit(step, network, state, x, pressures)

    def _newton(self, step: Any, network: NetworkStep, state: HeartState) -> tuple[Floats, Floats]:
        x, forces = self._predict(step, state, network.dt)
        pressures, previous, fresh = state.pressures.copy(), np.inf, False
        anderson = Anderson(np.concatenate([step.weights(x).ravel(), np.full(4, PRESSURE_WEIGHT)]))
        for _ in range(self.tolerances.iterations):
            gradients = self.body.volume_gradients(x)
            residual = forces - gradients @ pressures[:2]
            size, gap = step.size(residual), self._volume_gap(x, pressures, network, state)
            if size < self.tolerances.force and gap < self.tolerances.volume:
                return x, pressures
            fresh = self._factor is None or (not fresh and size > self.tolerances.contraction * previous)
            if fresh:
                self._renew(step, x, gradients)
                anderson.forget()
            previous = size
            change = -self._factor.solve(residual)
            new = self._solve_circuit(x, change, gradients, pressures, network, state)
            change += self._response @ (new - pressures)[:2]
            z, proposed = np.concatenate([x.ravel(), pressures]), np.concatenate([change, new - pressures])
            mixed = anderson.mix(z, proposed)
            x, forces = self._move(step, x, mixed[:-4].reshape(x.shape))
            pressures = pressures + mixed[-4:]
            self.iterations += 1
        raise StepFailed(f"no equilibrium in {self.tolerances.iterations} iterations, residual {size:.3g} N")

    @staticmethod
    def _predict(step: Any, state: HeartState, dt: float) -> tuple[Floats, Floats]:
        """First guess by extrapolation, with its forces; the old state where that is not admissible."""
        x: Floats = state.body.x
        velocity = sum(
            (c * v for c, v in zip(EXTRAPOLATION[len(state.trend)], state.trend, strict=True)), 0.0 * x
        )
        try:
            return x + dt * velocity, step.forces(x + dt * velocity)
        except StepFailed:
            return x.copy(), step.forces(x)

    def _renew(self, step: Any, x: Floats, gradients: Floats) -> None:
        self._factor = step.tangent(x)
        self._response = self._factor.solve(gradients)
        self.factorisations += 1

    def _volume_gap(self, x: Floats, pressures: Floats, network: NetworkStep, state: HeartState) -> float:
        out, _ = network.outflow(pressures)
        return float(np.abs(self.body.volumes(x) - state.volumes + network.dt * out[:2]).max())

    def _solve_circuit(
        self,
        x: Floats,
        change: Floats,
        gradients: Floats,
        pressures: Floats,
        network: NetworkStep,
        state: HeartState,
    ) -> Floats:
        """Pressures that balance the circuit, the body being linear about x + change."""
        volumes = self.body.volumes(x) + gradients.T @ change - state.volumes
        windkessels = self._affine(state, network.dt)
        return Circuit(network, windkessels, volumes, gradients.T @ self._response, pressures).solve()

    def _affine(self, state: HeartState, dt: float) -> Floats:
        """Rows (a, b) of the two Windkessels."""
        trees = zip(self.circulation.trees(), state.trees, strict=True)
        return np.array([tree.affine(held, dt) for tree, held in trees])

    @staticmethod
    def _move(step: Any, x: Floats, change: Floats) -> tuple[Floats, Floats]:
        """x + change and its forces, the change halved until no element collapses."""
        for _ in range(6):
            try:
                return x + change, step.forces(x + change)
            except StepFailed:
                change = 0.5 * change
        raise StepFailed("no admissible Newton step: elements collapse")

    def _commit(
        self, step: Any, network: NetworkStep, state: HeartState, x: Floats, pressures: Floats
    ) -> HeartState:
        out, _ = network.outflow(pressures)
        trees = tuple(
            tree.advance(held, -inflow, network.dt)
            for tree, held, inflow in zip(self.circulation.trees(), state.trees, out[2:], strict=True)
        )
        trend = ((x - state.body.x) / network.dt, *state.trend[:1])
        return HeartState(step.commit(x), pressures, self.body.volumes(x), trees, trend)  # type: ignore[arg-type]

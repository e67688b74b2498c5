r"""One time step of wall and circuit together.

The unknowns are those of the body, x, and the pressures of ventricles and arteries. Newton's method solves

.. math:: f(x) - \sum_c P_c \nabla V_c(x) = 0, \quad V_c(x) - V_c^* + w \sum q = 0, \quad
          P_a = a + b \sum q

with w and the starting values of :mod:`heartfit.heart.time_step`, and a factorisation K of
:math:`\partial f/\partial x` that is kept over many steps. In every iteration the body is condensed to its compliance
:math:`\nabla V^T K^{-1} \nabla V`, and the small circuit is solved to convergence, so that the kinks of the valves do
not affect the large system.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Protocol

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.circulation.circuit import Circuit
from heartfit.heart.circulation.enclosure import EnclosedBody
from heartfit.heart.circulation.network import Circulation, Network
from heartfit.heart.circulation.network_step import NetworkStep
from heartfit.heart.circulation.state import HeartState
from heartfit.heart.finite_elements.body import StepFailed
from heartfit.heart.muscle.tissue import Tissue
from heartfit.heart.time_step import Anderson, TimeStep
from heartfit.roles import External, Mechanism

EXTRAPOLATION_WEIGHTS: tuple[tuple[float, ...], ...] = ((), (1.0,), (2.0, -1.0))
"""Weights of the last velocities in the predicted one, by the number of velocities available."""

NEWTON_HALVINGS = 6
"""Largest number of halvings of a Newton step before the time step fails."""

PRESSURE_WEIGHT = 1e-4
"""Weight of a pressure [1/Pa], relative to the weights of the body, in the Anderson mixing."""

LARGEST_REUSED = 20_000
"""Number of unknowns up to which the factors of a beat are kept for the next one: twenty factors of 20 MB at most."""


class Body(Protocol):
    """Interface of a pair of ventricles: finite elements, or two spheres of the same tissue."""

    @property
    def tissue(self) -> Tissue: ...
    def rest(self) -> Any: ...
    def volumes(self, x: Floats) -> Floats: ...
    def volume_gradients(self, x: Floats) -> Floats: ...
    def step(self, state: Any, step: TimeStep) -> Any: ...
    def wall_volume(self, x: Floats) -> float: ...


@dataclass(frozen=True)
class Tolerances:
    """Convergence criteria of a step: residuals of the wall [N], the volumes [m^3] and the arterial pressures [Pa].

    A step takes up to ``iterations``; the factorisation is renewed where the residual shrinks by less than the factor
    ``contraction``.
    """

    force: float = 4e-2
    volume: float = 1e-10
    pressure: float = 1.0
    iterations: int = 25
    contraction: float = 0.8


@dataclass(frozen=True, eq=False)
class Iterate:
    """Trial state: unknowns, forces (N,), pressures (n,), volumes (2,) and their gradients (N, 2)."""

    x: Floats
    forces: Floats
    pressures: Floats
    volumes: Floats
    gradients: Floats

    @property
    def residual(self) -> Floats:
        """Imbalance (N,) of the wall and the cavity pressures."""
        result: Floats = self.forces - self.gradients @ self.pressures[:2]
        return result


class CoupledStep:
    """Equations of one step of wall and circuit."""

    def __init__(
        self, body: Any, step: Any, network: NetworkStep, time_step: TimeStep, state: HeartState
    ) -> None:
        self._body, self.step, self._network, self._state = body, step, network, state
        self.time_step = time_step
        self._volumes, self._trees = state.starting_values(time_step)
        self._windkessels = network.windkessels(self._trees)

    def predict(self, expected: Floats | None = None) -> Iterate:
        """Initial iterate: ``expected`` (n, dofs) or an extrapolation; the old state if elements collapse there."""
        state = self._state
        try:
            return self.at(self._extrapolated() if expected is None else expected, state.pressures)
        except StepFailed:
            return self.at(state.body.x, state.pressures)

    def _extrapolated(self) -> Floats:
        """Unknowns (n, dofs) at the end of the step if the velocity changes as before."""
        x, trend = self._state.body.x, self._state.trend
        weighted = zip(EXTRAPOLATION_WEIGHTS[len(trend)], trend, strict=True)
        velocity = sum((weight * before for weight, before in weighted), np.zeros_like(x))
        result: Floats = x + self.time_step.length * velocity
        return result

    def at(self, x: Floats, pressures: Floats) -> Iterate:
        """Iterate with the forces at ``x`` (n, dofs); raises StepFailed if an element collapses."""
        forces = self.step.forces(x)
        return Iterate(x, forces, pressures, self._body.volumes(x), self._body.volume_gradients(x))

    def residuals(self, now: Iterate) -> Floats:
        """Residuals (n,) of the circuit: volumes of ventricles and atria [m^3], pressures of the arteries [Pa]."""
        return self._circuit(now, np.zeros_like(now.residual), np.zeros_like(now.gradients)).residuals(
            now.pressures
        )

    def balanced(self, now: Iterate, tolerances: Tolerances) -> bool:
        """True if all residuals of the circuit are within the ``tolerances``."""
        limits = np.where(self._network.stores_blood, tolerances.volume, tolerances.pressure)
        return bool((np.abs(self.residuals(now)) < limits).all())

    def balance(self, now: Iterate, change: Floats, response: Floats) -> tuple[Floats, Floats]:
        """Change (N,) of the unknowns and pressures (n,) [Pa] that balance the circuit, the body linearised at ``now``.

        ``change`` (N,) is that at fixed pressures, ``response`` (N, 2) the one to the pressures of the ventricles.
        """
        pressures = self._circuit(now, change, response).solve()
        return change + response @ (pressures - now.pressures)[:2], pressures

    def _circuit(self, now: Iterate, change: Floats, response: Floats) -> Circuit:
        linearised = now.volumes + now.gradients.T @ change
        compliance = now.gradients.T @ response
        changes = linearised - self._volumes
        return Circuit(self._network, self._windkessels, changes, compliance, now.pressures, linearised)

    def follow(self, now: Iterate, change: Floats, pressures: Floats) -> Iterate:
        """Iterate after a small ``change`` (N,), to which the response of the wall is linear; its forces are those of
        ``now``."""
        x = now.x + change.reshape(now.x.shape)
        self.step.follow(x)
        return replace(now, x=x, pressures=pressures, volumes=self._body.volumes(x))

    def move(self, now: Iterate, change: Floats, pressures: Floats) -> Iterate:
        """Iterate after ``change``, which is halved until no element collapses."""
        for halving in range(NEWTON_HALVINGS):
            try:
                return self.at(now.x + 0.5**halving * change.reshape(now.x.shape), pressures)
            except StepFailed:
                continue
        raise StepFailed("no admissible Newton step: elements collapse")

    def commit(self, now: Iterate) -> HeartState:
        """State at the end of the step; the inflow of the Windkessels is the outflow of the ventricles."""
        state, length = self._state, self.time_step.length
        trees = self._network.advance(self._trees, now.pressures)
        trend = ((now.x - state.body.x) / length, *state.trend[:1])
        before = replace(state, before=None)
        body, branches = self.step.commit(now.x), self._network.branches()
        atria = self._network.atrial_state()
        return HeartState(body, now.pressures, now.volumes, trees, trend, length, before, branches, atria)


class Tangent(NamedTuple):
    """Factorised tangent for steps of an effective ``length`` [s], and the response (N, 2) to the cavity pressures."""

    factor: Any
    response: Floats
    length: float


class Coupling:
    """Time stepper of body and circuit; owns the factorised tangents that the steps share.

    A tangent serves until it contracts too little. In later beats the ones of the beat before return at their steps.
    """

    def __init__(
        self, body: Body, circulation: Circulation, mechanisms: Sequence[Mechanism], tolerances: Tolerances
    ) -> None:
        self.network = Network(circulation, mechanisms)
        loaded = any(isinstance(m, External) for m in mechanisms)
        self.body = EnclosedBody(body, mechanisms) if loaded else body
        self.tolerances = tolerances
        self.iterations = self.factorisations = 0
        self._tangent: Tangent | None = None
        self._renewed: dict[float, Tangent] = {}  # by the start of the step that renewed them

    def advance(self, state: HeartState, step: TimeStep, expected: Floats | None = None) -> HeartState:
        """State after ``step``; raises StepFailed if Newton's method does not converge.

        Newton's method begins at the ``expected`` unknowns (n, dofs), or at extrapolated ones.
        """
        coupled, now = self._solve(state, step, expected)
        return coupled.commit(now)

    def linearise(self, state: HeartState, step: TimeStep) -> "tuple[CoupledStep, Iterate, Any, Floats]":
        """Equations of ``step`` at their solution, with the factorised tangent there and the response (N, 2) to it.

        One more iteration, with this tangent, reduces the residual some hundredfold.
        """
        coupled, now = self._solve(state, step)
        self._tangent = self._tangent_at(coupled, now)
        factor, response, _ = self._tangent
        change, pressures = coupled.balance(now, -factor.solve(now.residual), response)
        return coupled, coupled.move(now, change, pressures), factor, response

    def _solve(
        self, state: HeartState, step: TimeStep, expected: Floats | None = None
    ) -> tuple[CoupledStep, Iterate]:
        """Equations of ``step`` and the iterate at which they hold to the tolerances."""
        tangent = self._renewed.get(step.start, self._tangent)
        self._tangent = tangent if tangent and tangent.length == step.effective else None
        coupled = self.equations(state, step)
        return coupled, self._newton(coupled, coupled.predict(expected))

    def equations(self, state: HeartState, step: TimeStep) -> CoupledStep:
        """Equations of ``step`` from ``state``."""
        equations = self.body.step(state.body, step)
        starts = state.starting_branches(step), state.starting_atria(step)
        network = NetworkStep(self.network, step.end, step.effective, step.period, *starts)
        return CoupledStep(self.body, equations, network, step, state)

    def _newton(self, coupled: CoupledStep, now: Iterate) -> Iterate:
        previous, renewed = np.inf, False
        anderson = Anderson(
            np.append(coupled.step.weights(now.x), np.full(len(now.pressures), PRESSURE_WEIGHT))
        )
        for _ in range(self.tolerances.iterations):
            size = coupled.step.size(now.residual)
            if size < self.tolerances.force and coupled.balanced(now, self.tolerances):
                return now
            stale = not renewed and size > self.tolerances.contraction * previous
            tangent, renewed, previous = self._tangent, self._tangent is None or stale, size
            if tangent is None or stale:
                tangent = self._renew(coupled, now)
                anderson.forget()
            now = self._iterate(coupled, now, tangent, anderson)
            self.iterations += 1
        raise StepFailed(f"no equilibrium in {self.tolerances.iterations} iterations, residual {size:.3g} N")

    def _renew(self, coupled: CoupledStep, now: Iterate) -> Tangent:
        """Tangent at ``now``, which serves from now on and again at this step of the next beat."""
        self._tangent = self._tangent_at(coupled, now)
        if now.x.size <= LARGEST_REUSED:
            self._renewed[coupled.time_step.start] = self._tangent
        return self._tangent

    def _tangent_at(self, coupled: CoupledStep, now: Iterate) -> Tangent:
        factor = coupled.step.tangent(now.x)
        self.factorisations += 1
        return Tangent(factor, factor.solve(now.gradients), coupled.time_step.effective)

    @staticmethod
    def _iterate(coupled: CoupledStep, now: Iterate, tangent: Tangent, anderson: Anderson) -> Iterate:
        change, pressures = coupled.balance(now, -tangent.factor.solve(now.residual), tangent.response)
        mixed = anderson.mix(np.append(now.x, now.pressures), np.append(change, pressures - now.pressures))
        n = len(pressures)
        return coupled.move(now, mixed[:-n], now.pressures + mixed[-n:])

r"""Ventricles of variable elastance, with the interface of the finite-element ventricles.

The unknowns are the cavity volumes themselves, :math:`P = E(t) (V - V_0)`: a body with a known answer, by which the
circulation is compared with other implementations.
"""

from dataclasses import dataclass, field

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.muscle.tissue import Tissue
from heartfit.heart.time_step import TimeStep


@dataclass(frozen=True)
class Elastance:
    r"""Elastance :math:`E(t) = E_A e(t) + E_B` [Pa/m^3] over an ``unstressed`` volume [m^3].

    e rises from ``onset`` for ``rise`` and falls for ``fall`` [s], by half cosines between 0 and 1.
    """

    active: float
    passive: float
    unstressed: float
    onset: float = 0.0
    rise: float = 0.25
    fall: float = 0.4

    def contraction(self, time: Floats, period: float) -> Floats:
        """Contraction e at ``time`` (any shape) [s]."""
        into = np.mod(np.asarray(time) - self.onset, period)
        rising = 0.5 * (1.0 - np.cos(np.pi * into / self.rise))
        falling = 0.5 * (1.0 + np.cos(np.pi * (into - self.rise) / self.fall))
        return np.where(into < self.rise, rising, np.where(into < self.rise + self.fall, falling, 0.0))

    def at(self, time: float, period: float) -> float:
        """Elastance at ``time`` [s]."""
        return self.active * float(self.contraction(np.array(time), period)) + self.passive


@dataclass(frozen=True, eq=False)
class ElastanceState:
    """Volumes ``x`` (2, 1) [m^3]."""

    x: Floats


@dataclass(frozen=True, eq=False)
class ElastanceBody:
    """Left and right ventricle of variable elastance."""

    left: Elastance
    right: Elastance
    tissue: Tissue = field(default_factory=Tissue)

    def rest(self) -> ElastanceState:
        return ElastanceState(np.array([[self.left.unstressed], [self.right.unstressed]]))

    def volumes(self, x: Floats) -> Floats:
        return x[:, 0].copy()

    def volume_gradients(self, x: Floats) -> Floats:  # noqa: ARG002
        return np.eye(2)

    def wall_volume(self, x: Floats) -> float:  # noqa: ARG002
        return 1.0

    def step(self, state: ElastanceState, step: TimeStep) -> "ElastanceStep":  # noqa: ARG002
        return ElastanceStep(self, np.array([side.at(step.end, step.period) for side in self.sides]))

    def static_step(self, state: ElastanceState) -> "ElastanceStep":  # noqa: ARG002
        return ElastanceStep(self, np.array([side.passive for side in self.sides]))

    @property
    def sides(self) -> tuple[Elastance, Elastance]:
        """Left and right ventricle."""
        return self.left, self.right


@dataclass(frozen=True, eq=False)
class ElastanceStep:
    """Pressures and elastances at the end of one step."""

    body: ElastanceBody
    elastance: Floats

    def forces(self, x: Floats) -> Floats:
        """Pressures (2,) [Pa] that the volumes hold."""
        return self.elastance * (x[:, 0] - self.body.rest().x[:, 0])

    def tangent(self, x: Floats) -> "ElastanceStep":  # noqa: ARG002
        return self

    def solve(self, right: Floats) -> Floats:
        """Change of the volumes by a change of the pressures."""
        return right / (self.elastance if right.ndim == 1 else self.elastance[:, None])

    def commit(self, x: Floats) -> ElastanceState:
        return ElastanceState(x.copy())

    def size(self, residual: Floats) -> float:
        return float(np.linalg.norm(residual))

    def weights(self, x: Floats) -> Floats:
        return np.full(x.size, 1e6)

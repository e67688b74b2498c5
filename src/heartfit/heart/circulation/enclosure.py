r"""Ventricles under an external pressure, with the interface of those without.

The walls are incompressible, so a pressure :math:`e_c` around ventricle c does the work :math:`-e_c\, dV_c`:

.. math:: f(x) + \sum_c e_c(\bar V, t) \nabla V_c = \sum_c P_c \nabla V_c,

and the stiffness gains the term :math:`\sum_c e_c' \nabla V_c \otimes \nabla \bar V` of rank one, which the formula of
Sherman and Morrison inverts. The loads are those at the end of the step, so the scheme keeps its order.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.time_step import TimeStep
from heartfit.roles import COMPARTMENTS, External, Mechanism
from heartfit.roles.laws import Load, outside_pressure

VENTRICLES = COMPARTMENTS[:2]


def load_table(
    mechanisms: Sequence[Mechanism], ventricles: Sequence[str], time: Floats, period: float
) -> Floats:
    """Coefficients (t, k, v, 4) of the k loads on v ventricles at ``time`` (t,) [s]; see ``Load``."""
    externals = [m for m in mechanisms if isinstance(m, External)]
    table = np.empty((len(time), len(externals), len(ventricles), len(Load._fields)))
    for k, mechanism in enumerate(externals):
        for v, name in enumerate(ventricles):
            for c, coefficient in enumerate(mechanism.load(name, time, period)):
                table[:, k, v, c] = coefficient
    return table


class EnclosedBody:
    """Ventricles of ``body`` under the external loads of ``mechanisms``."""

    def __init__(self, body: Any, mechanisms: Sequence[Mechanism]) -> None:
        self.body, self._mechanisms = body, mechanisms

    def volumes(self, x: Floats) -> Floats:
        return self.body.volumes(x)

    def volume_gradients(self, x: Floats) -> Floats:
        return self.body.volume_gradients(x)

    def step(self, state: Any, step: TimeStep) -> "EnclosedStep":
        loads = load_table(self._mechanisms, VENTRICLES, np.array([step.end]), step.period)
        return EnclosedStep(self.body, self.body.step(state, step), loads)


class EnclosedStep:
    """Equations of one step of the walls under their loads."""

    def __init__(self, body: Any, step: Any, loads: Floats) -> None:
        self._body, self._step, self._loads = body, step, loads
        self.commit, self.size, self.weights = step.commit, step.size, step.weights

    def forces(self, x: Floats) -> Floats:
        """Internal forces plus those of the loads (N,)."""
        return self._step.forces(x) + self._body.volume_gradients(x) @ self._outside(x)[0]

    @property
    def wall(self) -> Any:
        """The step of the wall without the loads."""
        return self._step

    def follow(self, x: Floats) -> None:
        self._step.follow(x)

    def tangent(self, x: Floats) -> "EnclosedStiffness":
        gradients = self._body.volume_gradients(x)
        return EnclosedStiffness(
            self._step.tangent(x), gradients @ self._outside(x)[1], gradients.mean(axis=1)
        )

    def _outside(self, x: Floats) -> tuple[Floats, Floats]:
        """Pressures (2,) around the ventricles [Pa] and their derivatives by the mean volume [Pa/m^3]."""
        mean = self._body.volumes(x).mean()
        pressure, slope = zip(
            *(outside_pressure(self._loads, 0, v, mean) for v in range(len(VENTRICLES))), strict=True
        )
        return np.array(pressure), np.array(slope)


class EnclosedStiffness:
    """Stiffness K + u w^T, from a factorisation of K."""

    def __init__(self, factor: Any, u: Floats, w: Floats) -> None:
        self._factor, self._w = factor, w
        softened = factor.solve(u)
        self._softened = softened / (1.0 + w @ softened)

    def solve(self, right: Floats) -> Floats:
        """Solution for one (N,) or many (N, m) right-hand sides."""
        free = self._factor.solve(right)
        return free - np.multiply.outer(self._softened, self._w @ free)

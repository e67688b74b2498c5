r"""The circuit of one step, the ventricles being replaced by their linear response to pressure.

Unknown are the pressures p of both ventricles and both arteries:

.. math:: v + G (p_v - p_v^0) + \Delta t\, q_v(p) = 0, \qquad p_a - a + b\, q_a(p) = 0,

with v the change of the ventricular volumes since the start of the step at :math:`p^0`, G their compliance,
q the net outflow of the compartments and (a, b) the Windkessels. The equations are monotone but kinked by the
valves: Newton's method with a line search.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.circulation.network import NetworkStep
from heartfit.geometry.arrays import Floats

SCALE = np.array([1e-6, 1e-6, 1e3, 1e3])
"""A millilitre and a kilopascal: what counts as one in the residual."""

ITERATIONS, HALVINGS, TOLERANCE = 40, 10, 1e-9


@dataclass(frozen=True, eq=False)
class Circuit:
    """Equations of the condensed circuit; see the module."""

    network: NetworkStep
    windkessels: Floats
    volume_change: Floats
    compliance: Floats
    start: Floats

    def solve(self) -> Floats:
        """Pressures (4,) that balance the circuit; the best found if the line search ends before that."""
        p = self.start.copy()
        residual, slope = self._equations(p)
        for _ in range(ITERATIONS):
            size = float(np.linalg.norm(residual))
            if size < TOLERANCE:
                break
            move = np.linalg.solve(slope, -residual)
            for halving in range(HALVINGS):
                trial = p + 0.5**halving * move
                following, slope = self._equations(trial)
                if np.linalg.norm(following) < size:
                    break
            p, residual = trial, following
        return p

    def gaps(self, p: Floats) -> Floats:
        """Residual (4,) at the pressures p: m^3 for the ventricles, Pa for the arteries."""
        return self._equations(p)[0] * SCALE

    def _equations(self, p: Floats) -> tuple[Floats, Floats]:
        out, slope = self.network.outflow(p)
        a, b = self.windkessels.T
        volumes = self.volume_change + self.compliance @ (p - self.start)[:2] + self.network.dt * out[:2]
        jacobian = np.vstack([self.network.dt * slope[:2], b[:, None] * slope[2:]])
        jacobian[:2, :2] += self.compliance
        jacobian[2:, 2:] += np.eye(2)
        residual = np.concatenate([volumes, p[2:] - a + b * out[2:]])
        return residual / SCALE, jacobian / SCALE[:, None]

r"""The active stress of the benchmark of cardiac elastodynamics, by the contractile law of the wall.

.. math::
    \dot\tau = -|a| \tau + \sigma_0 |a|_+, \qquad a = \alpha_{max} f + \alpha_{min} (1 - f), \qquad
    f = S^+(t - t_{sys})\, S^-(t - t_{dias}), \qquad S^\pm = \tfrac12 (1 \pm \tanh(t / \gamma)) .

This is the law of Bestel, Clement and Sorine for fibres that are held (:math:`\dot e_c = 0`): the series element is
made stiff and the friction left out; k_0 and alpha then play no part. The control enters by its means over the steps.
Source: Arostica et al., Comput. Methods Appl. Mech. Eng. 435 (2025) 117485.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.mechanics.active.bcs import BestelClementSorine, tension
from heartfit.mechanics.time_step import TimeStep

LAW = BestelClementSorine(sigma_0=150e3, mu=0.0, E_s=1e11)
END = 0.6
"""The stress rises from 0.16 s on and falls from 0.48 s on."""

NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True)
class SmoothControl:
    """The control a(t), 1/s, with edges of width ``gamma`` (s)."""

    alpha_max: float = 5.0
    alpha_min: float = -30.0
    t_sys: float = 0.16
    t_dias: float = 0.484
    gamma: float = 5e-3

    def rate(self, t: Floats) -> Floats:
        """a(t)."""
        rise = 0.5 * (1.0 + np.tanh((t - self.t_sys) / self.gamma))
        f = rise * 0.5 * (1.0 - np.tanh((t - self.t_dias) / self.gamma))
        result: Floats = self.alpha_max * f + self.alpha_min * (1.0 - f)
        return result

    def mean(self, start: float, dt: float) -> tuple[Floats, Floats]:
        """Means (1,) of |a| and of |a|_+ over ``[start, start + dt]``, by Gauss's rule."""
        a = self.rate(start + 0.5 * dt * (1.0 + NODES))
        return np.array([0.5 * WEIGHTS @ abs(a)]), np.array([0.5 * WEIGHTS @ np.maximum(a, 0.0)])


def active_stress(dt: float, law: BestelClementSorine = LAW) -> tuple[Floats, Floats]:
    """Times (n,) and fibre stress (n,), Pa, of a fibre at zero strain, in steps of ``dt``."""
    control, state, held = SmoothControl(), law.rest(1), np.zeros(1)
    stresses = [0.0]
    for step in range(round(END / dt)):
        drive = law.drive(TimeStep(step * dt, dt, END), control.mean(step * dt, dt), state)
        out = law.begin(held, state)
        law.respond(drive, held, held, state, out)
        state = law.advance(drive, state, out[2])
        stresses.append(float(tension(state)[0]))
    return np.linspace(0.0, END, len(stresses)), np.array(stresses)

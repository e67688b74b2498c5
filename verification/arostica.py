r"""Active stress of the benchmark of cardiac elastodynamics, by the contractile law of the wall.

.. math::
    \dot\tau = -|a| \tau + \sigma_0 |a|_+, \qquad a = \alpha_{max} f + \alpha_{min} (1 - f), \qquad
    f = S^+(t - t_{sys})\, S^-(t - t_{dias}), \qquad S^\pm = \tfrac12 (1 \pm \tanh(t / \gamma)) .

This is the law of Bestel, Clement and Sorine for fibres of constant length (:math:`\dot e_c = 0`) with a stiff series
element and without friction; k_0 and alpha then have no effect. The control enters by its means over the steps.
Source: Arostica et al., Comput. Methods Appl. Mech. Eng. 435 (2025) 117485.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.muscle.bcs import BestelClementSorine, tension
from heartfit.heart.time_step import TimeStep
from verification.check import Check

LAW = BestelClementSorine(sigma_0=150e3, mu=0.0, E_s=1e11)
END = 0.6
"""End of the simulation [s]; the stress rises from 0.16 s on and falls from 0.48 s on."""

NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True)
class SmoothControl:
    """Control a(t) [1/s] with edges of width ``gamma`` [s]."""

    alpha_max: float = 5.0
    alpha_min: float = -30.0
    t_sys: float = 0.16
    t_dias: float = 0.484
    gamma: float = 5e-3

    def rate(self, t: Floats) -> Floats:
        """a(t) [1/s]."""
        rise = 0.5 * (1.0 + np.tanh((t - self.t_sys) / self.gamma))
        f = rise * 0.5 * (1.0 - np.tanh((t - self.t_dias) / self.gamma))
        result: Floats = self.alpha_max * f + self.alpha_min * (1.0 - f)
        return result

    def mean(self, start: float, dt: float) -> tuple[Floats, Floats]:
        """Means (1,) of |a| and of |a|_+ over ``[start, start + dt]``, by Gaussian quadrature."""
        a = self.rate(start + 0.5 * dt * (1.0 + NODES))
        return np.array([0.5 * WEIGHTS @ abs(a)]), np.array([0.5 * WEIGHTS @ np.maximum(a, 0.0)])


def active_stress(dt: float, law: BestelClementSorine = LAW) -> tuple[Floats, Floats]:
    """Times (n,) [s] and stress (n,) [Pa] of a fibre at zero strain, in steps of ``dt`` [s]."""
    control, state, strain = SmoothControl(), law.rest(1), np.zeros(1)
    stresses = [0.0]
    for step in range(round(END / dt)):
        drive = law.drive(TimeStep(step * dt, dt, END), control.mean(step * dt, dt), state)
        out = law.begin(strain, state)
        law.respond(drive, strain, strain, state, out)
        state = law.advance(drive, state, out[2])
        stresses.append(float(tension(state)[0]))
    return np.linspace(0.0, END, len(stresses)), np.array(stresses)


STEP = 5e-4
MAXIMUM, TIME = 118.106, 479.5
"""[kPa] and [ms], from the equation of the benchmark solved to ten digits; a test repeats the solution."""

SOURCE = "Arostica et al. 2025"


def arostica_checks() -> list[Check]:
    """Check the maximum to 0.1 % and its time to one step."""
    times, stress = active_stress(STEP)
    largest, at = 1e-3 * float(stress.max()), 1e3 * float(times[np.argmax(stress)])
    return [
        Check("active stress: maximum, steps of 0.5 ms", largest, MAXIMUM, 0.118, "kPa", SOURCE),
        Check("active stress: time of the maximum", at, TIME, 0.5, "ms", SOURCE),
    ]

r"""Bestel-Clement-Sorine sarcomere, series rheology A, with an energy-balanced local update.

Attached cross-bridges of stiffness :math:`k_c` and stress :math:`\tau_c`, driven by the control :math:`u`:

.. math::
    \dot k_c &= -(|u| + \alpha |\dot e_c|) k_c + n_0 k_0 |u|_+ \\
    \dot\tau_c &= -(|u| + \alpha |\dot e_c|) \tau_c + \dot e_c k_c + n_0 \sigma_0 |u|_+

in series with an elastic element, :math:`1 + 2 e_{1D} = (1 + 2 e_c)(1 + 2 e_s)`,

.. math:: \sigma_{1D} = \frac{\tau_c + \mu \dot e_c}{1 + 2 e_s} = \frac{E_s e_s}{1 + 2 e_c}.

The update advances :math:`k_c` and :math:`\lambda_c = \tau_c/\sqrt{k_c}` and finds the increment
:math:`d = e_c^{n+1} - e_c^n` from one scalar equation. The bridge energy is :math:`\lambda_c^2/2`, that of the
spring :math:`E_s e_s^2/2`; both balance exactly in every step, of any length.
Sources: Marchesseau et al., MICCAI 2012, eq. (1); Chapelle et al., IJMCE 10 (2012) for the change of variable;
the scheme of the kinetics is that of PhysioBlocks' cardiac model.
"""

from dataclasses import dataclass, field

import numpy as np
from numba import njit

from heartfit.geometry.arrays import Floats
from heartfit.mechanics.active.starling import Starling
from heartfit.mechanics.kinematics import StepFailed
from heartfit.parameter import parameter, require_admissible

BRIDGE_FLOOR = 1.0
"""Smallest bridge stiffness k_c, Pa: keeps sqrt(k_c) differentiable in a relaxed muscle."""

LARGEST_INCREMENT = 0.1
"""Largest change of e_c in a step; beyond it the scalar equation has spurious roots."""


CONVERGED = 1e-12
"""Change of e_c, below which its equation is solved: E_s times it is far below a pascal."""


@dataclass(frozen=True)
class BestelClementSorine:
    """Contractile law: five constants and the length dependence of the number of available bridges."""

    sigma_0: float = parameter(280e3, unit="Pa", symbol=r"\sigma_0", meaning="maximum contractility", sd=0.20)
    k_0: float = parameter(120e3, unit="Pa", symbol="k_0", meaning="maximum bridge stiffness", sd=0.30)
    alpha: float = parameter(
        8.0, unit="1", symbol=r"\alpha", meaning="bridge destruction by fast motion", sd=0.4
    )
    mu: float = parameter(9e3, unit="Pa.s", symbol=r"\mu", meaning="friction in the sarcomere", sd=0.20)
    E_s: float = parameter(3e7, unit="Pa", symbol="E_s", meaning="stiffness of the series element", sd=0.30)
    starling: Starling = field(default_factory=Starling)

    def __post_init__(self) -> None:
        require_admissible(self)

    def rest(self, points: int) -> Floats:
        """State (3, m) of relaxed fibres: rows :math:`e_c, k_c, \\lambda_c`."""
        state = np.zeros((3, points))
        state[1] = BRIDGE_FLOOR
        return state

    def constants(self) -> Floats:
        return np.array([self.sigma_0, self.k_0, self.alpha, self.mu, self.E_s])

    def respond(self, drive: "Drive", e_old: Floats, e_new: Floats, state: Floats, out: Floats) -> None:
        """Fill ``out`` (3, m) with fibre stress, its derivative by ``e_new`` and the increment of ``e_c``.

        An endless step (``drive.dt`` infinite) of relaxed fibres has no stress: bridges detach, the rest follows.
        """
        if np.isinf(drive.dt):
            out[:2], out[2] = 0.0, e_new - state[0]
            return
        _respond(drive.rate, drive.attach, drive.n_0, drive.dt, self.constants(), e_old, e_new, state, out)

    def advance(self, drive: "Drive", state: Floats, increment: Floats) -> Floats:
        """State (3, m) at the end of a step in which ``e_c`` changed by ``increment``.

        Raises StepFailed where the increment met its bound: the fibre equation has no solution in it then.
        """
        if np.isinf(drive.dt):
            return np.vstack([state[0] + increment, self.rest(increment.size)[1:]])
        if np.abs(increment).max() >= LARGEST_INCREMENT:
            raise StepFailed(f"e_c of a fibre changed by {LARGEST_INCREMENT:g} in a step of {drive.dt:.2g} s")
        return _advance(drive.rate, drive.attach, drive.n_0, drive.dt, self.constants(), state, increment)


@dataclass(frozen=True)
class Drive:
    """What drives the fibres during one step: mean |u|, mean |u|_+, n_0 (all (m,)) and the step's length."""

    rate: Floats
    attach: Floats
    n_0: Floats
    dt: float


def tension(state: Floats) -> Floats:
    r"""Active stress :math:`\tau_c = \lambda_c \sqrt{k_c}`, Pa."""
    result: Floats = state[2] * np.sqrt(state[1])
    return result


@njit(cache=True)
def _bridges(d, rate, attach, n_0, dt, constants, k, lam):  # type: ignore[no-untyped-def]
    """New stiffness, mean lambda and the bridge stress tau#, with the derivative of the latter by ``d``."""
    sigma_0, k_0, alpha = constants[0], constants[1], constants[2]
    s = 1.0 if d >= 0.0 else -1.0
    g = 1.0 + dt * rate + alpha * abs(d)
    kn = max((k + dt * n_0 * k_0 * attach) / g, BRIDGE_FLOOR)
    root = np.sqrt(kn)
    b = dt * n_0 * attach * sigma_0
    numerator = lam + 0.5 * (root * d + b / root)
    denominator = 1.0 + 0.25 * (dt * rate + alpha * abs(d)) + 0.25 * dt * n_0 * attach * k_0 / kn
    mean = numerator / denominator
    dk = -kn * alpha * s / g if kn > BRIDGE_FLOOR else 0.0
    droot = 0.5 * dk / root
    dnum = 0.5 * (droot * d + root - b / kn * droot)
    dden = 0.25 * alpha * s - 0.25 * dt * n_0 * attach * k_0 * dk / (kn * kn)
    dmean = (dnum - mean * dden) / denominator
    return kn, mean, root * mean, droot * mean + root * dmean


@njit(cache=True)
def _series(d, e_old, e_new, e_c, E_s):  # type: ignore[no-untyped-def]
    """Fibre stress sigma# and contractile stress sigma_c# of the spring, each with d/de and d/dd."""
    es_old = (e_old - e_c) / (1.0 + 2.0 * e_c)
    outer = 1.0 + 2.0 * (e_c + d)
    es_new = (e_new - e_c - d) / outer
    mean = 0.5 * (es_old + es_new)
    A, B = 1.0 + 2.0 * e_c + d, 1.0 + 2.0 * mean
    es_e, es_d = 1.0 / outer, -(1.0 + 2.0 * e_new) / (outer * outer)
    s = E_s * mean / A
    s_e, s_d = E_s * es_e / (2.0 * A), E_s * es_d / (2.0 * A) - E_s * mean / (A * A)
    return s, s_e, s_d, s * B, B * s_e + s * es_e, B * s_d + s * es_d


@njit(cache=True)
def _imbalance(d, rate, attach, n_0, dt, constants, e_old, e_new, e_c, k, lam):  # type: ignore[no-untyped-def]
    mu, E_s = constants[3], constants[4]
    _, _, stress, stress_d = _bridges(d, rate, attach, n_0, dt, constants, k, lam)
    s, s_e, s_d, c, c_e, c_d = _series(d, e_old, e_new, e_c, E_s)
    slope = stress_d + mu / dt - c_d
    return stress + mu * d / dt - c, slope, s, s_e + s_d * c_e / slope


@njit(cache=True)
def _increment(rate, attach, n_0, dt, constants, e_old, e_new, e_c, k, lam):  # type: ignore[no-untyped-def]
    """Newton from an unchanged spring (it is stiff), safeguarded by a bracket."""
    low, high = -LARGEST_INCREMENT, LARGEST_INCREMENT
    spring = (e_old - e_c) / (1.0 + 2.0 * e_c)
    d = min(max((e_new - spring) / (1.0 + 2.0 * spring) - e_c, low), high)
    for _ in range(60):
        value, slope, s, ds = _imbalance(d, rate, attach, n_0, dt, constants, e_old, e_new, e_c, k, lam)
        if value > 0.0:
            high = d
        else:
            low = d
        following = d - value / slope if slope > 0.0 else 0.5 * (low + high)
        if not low <= following <= high:
            following = 0.5 * (low + high)
        change = abs(following - d)
        d = following
        if change < CONVERGED:
            break
    _, _, s, ds = _imbalance(d, rate, attach, n_0, dt, constants, e_old, e_new, e_c, k, lam)
    return d, s, ds


@njit(cache=True)
def _respond(rate, attach, n_0, dt, constants, e_old, e_new, state, out):  # type: ignore[no-untyped-def]
    for i in range(e_new.size):
        d, s, ds = _increment(
            rate[i],
            attach[i],
            n_0[i],
            dt,
            constants,
            e_old[i],
            e_new[i],
            state[0, i],
            state[1, i],
            state[2, i],
        )
        out[0, i], out[1, i], out[2, i] = s, ds, d


@njit(cache=True)
def _advance(rate, attach, n_0, dt, constants, state, increment):  # type: ignore[no-untyped-def]
    new = np.empty_like(state)
    for i in range(increment.size):
        k, mean, _, _ = _bridges(
            increment[i], rate[i], attach[i], n_0[i], dt, constants, state[1, i], state[2, i]
        )
        new[0, i] = state[0, i] + increment[i]
        new[1, i] = k
        new[2, i] = 2.0 * mean - state[2, i]
    return new

r"""Bestel-Clement-Sorine sarcomere in series rheology A or B, with an energy-balanced local update.

Attached cross-bridges of stiffness :math:`k_c` and stress :math:`\tau_c`, driven by the control :math:`u`:

.. math::
    \dot k_c &= -(|u| + \alpha |\dot e_c|) k_c + n_0 k_0 |u|_+ \\
    \dot\tau_c &= -(|u| + \alpha |\dot e_c|) \tau_c + \dot e_c k_c + n_0 \sigma_0 |u|_+

with a friction that the attached bridges carry in part,

.. math:: \mu(k_c) = \mu \Big[ r + (1 - r) \min\big(1, 2 k_c / k_0\big) \Big] ,

r = 1 in the standard sarcomere, in series with an elastic element, :math:`1 + 2 e_{1D} = (1 + 2 e_c)(1 + 2 e_s)`,

.. math:: \sigma_{1D} = \frac{\tau_c + \mu(k_c) \dot e_c}{1 + 2 e_s} = \frac{E_s e_s}{1 + 2 e_c}.

This is rheology A. Rheology B adds engineering strains, :math:`\sqrt{1 + 2 e_{1D}} - 1 = e_c + e_s`, with the tension
:math:`T = E_s e_s = \tau_c + \mu \dot e_c` and :math:`\sigma_{1D} = T / \sqrt{1 + 2 e_{1D}}`.

The update advances :math:`r = \sqrt{k_c}` and :math:`\lambda_c = \tau_c/r` and finds the increment
:math:`d = e_c^{n+1} - e_c^n` from one scalar equation. The bridge energy is :math:`\lambda_c^2/2`, that of the spring
:math:`E_s e_s^2/2`; both balance exactly in every step, of any length. In the second-order scheme, destruction acts on
:math:`\bar r^2`, :math:`\bar r = (r^n + r^{n+1})/2`,

.. math:: (r^{n+1})^2 - (r^n)^2 = -x \bar r^2 + s k_0, \qquad x = \Delta t |u| + \alpha |d|, \quad
          s = \Delta t\, n_0 |u|_+ ,

which preserves :math:`\tau_c/k_c = \sigma_0/k_0` for bridges that attach to a sarcomere of constant length; in the
first-order scheme it acts on :math:`k_c^{n+1}`.
Sources: Marchesseau et al., MICCAI 2012, eq. (1); Chapelle et al., IJMCE 10 (2012) for the change of variable;
the scheme of first order is that of PhysioBlocks' cardiac model.
"""

from dataclasses import dataclass, field

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.heart.finite_elements.kinematics import StepFailed
from heartfit.heart.muscle.control import Starling
from heartfit.heart.muscle.spring import frozen_spring_slope, green_strain, spring_response
from heartfit.heart.time_step import TimeStep

BRIDGE_FLOOR = 1.0
"""Smallest bridge stiffness k_c [Pa]: keeps sqrt(k_c) differentiable in a relaxed muscle."""

LARGEST_INCREMENT = 0.1
"""Largest change of e_c in a step: beyond it the scalar equation has spurious roots."""

STRAIN_TOLERANCE = 1e-8
"""Newton step in e_c that ends the iteration; the stress is then corrected to first order, E_s times its square being
below 1 Pa."""


@dataclass(frozen=True)
class BestelClementSorine:
    """Contractile law: five constants and the length dependence of the number of available bridges.

    ``additive`` selects the series element of PhysioBlocks (rheology B).
    """

    sigma_0: float = parameter(300e3, unit="Pa", symbol=r"\sigma_0", meaning="maximum contractility", sd=0.20)
    k_0: float = parameter(120e3, unit="Pa", symbol="k_0", meaning="maximum bridge stiffness", sd=0.30)
    alpha: float = parameter(
        8.0, unit="1", symbol=r"\alpha", meaning="bridge destruction by fast motion", sd=0.4
    )
    mu: float = parameter(9e3, unit="Pa.s", symbol=r"\mu", meaning="friction in the sarcomere", sd=0.20)
    E_s: float = parameter(3e7, unit="Pa", symbol="E_s", meaning="stiffness of the series element", sd=0.30)
    relaxed_friction: float = parameter(
        1.0,
        unit="1",
        symbol="r",
        meaning="friction of a sarcomere without bridges, as a share of mu",
        low=0.01,
    )
    starling: Starling = field(default_factory=Starling)
    additive: bool = False

    def __post_init__(self) -> None:
        require_admissible(self)

    def rest(self, points: int) -> Floats:
        """State (4, m) of relaxed fibres: rows :math:`e_c, k_c, \\lambda_c` and the rate of e_c, 1/s."""
        state = np.zeros((4, points))
        state[1] = BRIDGE_FLOOR
        return state

    def unstressed(self, e: Floats) -> Floats:
        """Contractile strain of relaxed fibres of the strain ``e``, at which the spring is unstressed."""
        return np.sqrt(1.0 + 2.0 * e) - 1.0 if self.additive else e

    def constants(self) -> Floats:
        return np.array(
            [self.sigma_0, self.k_0, self.alpha, self.mu, self.E_s, self.additive, self.relaxed_friction]
        )

    def friction(self, k_c: Floats) -> Floats:
        """Friction mu(k_c) [Pa s] of fibres whose bridges have the stiffness ``k_c`` (any shape) [Pa]."""
        bound = np.minimum(1.0, 2.0 * k_c / self.k_0)
        result: Floats = self.mu * (self.relaxed_friction + (1.0 - self.relaxed_friction) * bound)
        return result

    def drive(
        self, step: TimeStep, control: tuple[Floats, Floats], state: Floats, kept: Floats | float = 1.0
    ) -> "Drive":
        """Drive during ``step`` of fibres in the ``state`` (4, m), for the ``control``: means of |u| and |u|_+ [1/s].

        ``kept`` (m,) is the share of the bridges that no mechanism removes.
        """
        ahead = 0.5 * step.length * state[3] if step.second_order else 0.0
        n_0 = kept * self.starling.available_fraction(green_strain(self.additive, state[0] + ahead))
        return Drive(*control, n_0, step.length, step.second_order)

    def begin(self, e_old: Floats, state: Floats) -> Floats:
        """Array (5, m) for the responses of one step, see :meth:`respond`; the guess leaves the springs unchanged."""
        out = np.zeros((5, e_old.size))
        out[3] = frozen_spring_slope(self.additive, e_old, state[0])
        out[4] = e_old
        return out

    def respond(self, drive: "Drive", e_old: Floats, e_new: Floats, state: Floats, out: Floats) -> None:
        """Fill the rows of ``out`` (5, m), created by :meth:`begin`, at the strains ``e_new`` (m,).

        The rows are the mean fibre stress over the step [Pa], its derivative by ``e_new``, the increment of ``e_c``,
        its derivative, and ``e_new`` itself, from which the next call starts. In a static step (``drive.dt`` infinite)
        all bridges detach: relaxed fibres have no stress, and ``e_c`` follows the strain.
        """
        if np.isinf(drive.dt):
            out[:2], out[2] = 0.0, self.unstressed(e_new) - state[0]
            return
        inputs = drive.rate, drive.attach, drive.n_0
        _respond(*inputs, drive.dt, drive.second_order, self.constants(), e_old, e_new, state, out)

    def correct(self, drive: "Drive", e_old: Floats, e_new: Floats, state: Floats, out: Floats) -> None:
        """Correct the guess in ``out`` once: :meth:`respond` in a step of finite length, near its solution."""
        inputs = drive.rate, drive.attach, drive.n_0
        _correct(*inputs, drive.dt, drive.second_order, self.constants(), e_old, e_new, state, out)

    def advance(self, drive: "Drive", state: Floats, increment: Floats) -> Floats:
        """State (4, m) at the end of a step in which ``e_c`` changed by ``increment`` (m,).

        Raises StepFailed if an increment reaches LARGEST_INCREMENT: the fibre equation has no solution below it.
        """
        if np.isinf(drive.dt):
            return np.vstack([state[0] + increment, self.rest(increment.size)[1:]])
        if np.abs(increment).max() >= LARGEST_INCREMENT:
            raise StepFailed(
                f"e_c of a fibre changed by {LARGEST_INCREMENT:g} or more in a step of {drive.dt:.2g} s"
            )
        inputs = drive.rate, drive.attach, drive.n_0
        return _advance(*inputs, drive.dt, drive.second_order, self.constants(), state, increment)


@dataclass(frozen=True)
class Drive:
    """Drive of m fibres during one step: means of |u| and |u|_+ [1/s], n_0, and length [s] and order of the step."""

    rate: Floats
    attach: Floats
    n_0: Floats
    dt: float
    second_order: bool = True


def tension(state: Floats) -> Floats:
    r"""Active stress :math:`\tau_c = \lambda_c \sqrt{k_c}` [Pa]."""
    result: Floats = state[2] * np.sqrt(state[1])
    return result


@njit(cache=True, error_model="numpy", inline="always")
def _bridge_root(d, rate, attach, n_0, dt, second_order, constants, k):  # type: ignore[no-untyped-def]
    """k_c at the end of the step, mean of sqrt(k_c) of the scheme, and the derivative of the mean by ``d``."""
    k_0, alpha = constants[1], constants[2]
    x, formed = dt * rate + alpha * abs(d), dt * n_0 * k_0 * attach
    slope = alpha if d >= 0.0 else -alpha
    if not second_order:
        new = (k + formed) / (1.0 + x)
        if new <= BRIDGE_FLOOR:
            return BRIDGE_FLOOR, np.sqrt(BRIDGE_FLOOR), 0.0
        root = np.sqrt(new)
        return new, root, -0.5 * root * slope / (1.0 + x)
    g, old = 1.0 + 0.25 * x, np.sqrt(k)
    square = np.sqrt(k + g * formed)
    root = (square - 0.25 * x * old) / g
    if root * root <= BRIDGE_FLOOR:
        return BRIDGE_FLOOR, 0.5 * (old + np.sqrt(BRIDGE_FLOOR)), 0.0
    change = 0.25 * slope * (0.5 * formed / square - old - root) / g
    return root * root, 0.5 * (old + root), 0.5 * change


@njit(cache=True, error_model="numpy", inline="always")
def bridges(d, rate, attach, n_0, dt, second_order, constants, k, lam):  # type: ignore[no-untyped-def]
    """Response of the bridges to the increment ``d`` of e_c.

    Returned are their stiffness at the end of the step, the mean of lambda_c, the stress tau# and its derivative by
    ``d``, and the mean of sqrt(k_c) and its derivative, on which the friction depends.
    """
    sigma_0, k_0, alpha = constants[0], constants[1], constants[2]
    new, root, droot = _bridge_root(d, rate, attach, n_0, dt, second_order, constants, k)
    slope = alpha if d >= 0.0 else -alpha
    formed, inverse = dt * n_0 * attach, 1.0 / root
    gain, loss = formed * sigma_0 * inverse, 0.25 * formed * k_0 * inverse * inverse
    shrink = 1.0 / (1.0 + 0.25 * (dt * rate + alpha * abs(d)) + loss)
    mean = (lam + 0.5 * (root * d + gain)) * shrink
    dnum = 0.5 * (droot * d + root - gain * inverse * droot)
    dmean = (dnum - mean * (0.25 * slope - 2.0 * loss * inverse * droot)) * shrink
    return new, mean, root * mean, droot * mean + root * dmean, root, droot


@njit(cache=True, error_model="numpy")
def friction(constants, root, droot):  # type: ignore[no-untyped-def]
    """Friction mu(k_c) [Pa s] at the mean ``root`` of sqrt(k_c), and its derivative by d, from that of the mean."""
    k_0, mu, rest = constants[1], constants[3], constants[6]
    if rest == 1.0:
        return mu, 0.0
    bound = 2.0 * root * root / k_0
    if bound >= 1.0:
        return mu, 0.0
    return mu * (rest + (1.0 - rest) * bound), mu * (1.0 - rest) * 4.0 * root * droot / k_0


@njit(cache=True, error_model="numpy", inline="always")
def _imbalance(d, rate, attach, n_0, dt, second_order, constants, e_old, e_new, e_c, k, lam):  # type: ignore[no-untyped-def]
    """Left-hand side of the equation of ``d`` and its slope; the stress, its derivatives by e and d, and dc/de."""
    _, _, tau, tau_d, root, droot = bridges(d, rate, attach, n_0, dt, second_order, constants, k, lam)
    s, s_e, s_d, c, c_e, c_d = spring_response(d, e_old, e_new, e_c, constants[4], constants[5] > 0.0)
    mu, mu_d = friction(constants, root, droot)
    return tau + mu * d / dt - c, tau_d + (mu + mu_d * d) / dt - c_d, s, s_e, s_d, c_e


@njit(cache=True, error_model="numpy", inline="always")
def fibre_response(rate, attach, n_0, dt, second_order, constants, e_old, e_new, e_c, k, lam, d):  # type: ignore[no-untyped-def]
    """Stress, its slope, increment and its slope, by Newton's method from the guess ``d``, safeguarded by bisection."""
    low, high = -LARGEST_INCREMENT, LARGEST_INCREMENT
    d = min(max(d, low), high)
    for _ in range(60):
        value, slope, s, s_e, s_d, c_e = _imbalance(
            d, rate, attach, n_0, dt, second_order, constants, e_old, e_new, e_c, k, lam
        )
        if value > 0.0:
            high = d
        else:
            low = d
        following = d - value / slope if slope > 0.0 else 0.5 * (low + high)
        if not low <= following <= high:
            following = 0.5 * (low + high)
        change = following - d
        d = following
        if abs(change) < STRAIN_TOLERANCE:
            break
    increment_slope = c_e / slope
    return s + s_d * change, s_e + s_d * increment_slope, d, increment_slope


@njit(cache=True, error_model="numpy")
def _respond(rate, attach, n_0, dt, second_order, constants, e_old, e_new, state, out):  # type: ignore[no-untyped-def]
    for i in range(e_new.size):
        guess = out[2, i] + out[3, i] * (e_new[i] - out[4, i])
        e_c, k, lam = state[0, i], state[1, i], state[2, i]
        out[0, i], out[1, i], out[2, i], out[3, i] = fibre_response(
            rate[i], attach[i], n_0[i], dt, second_order, constants, e_old[i], e_new[i], e_c, k, lam, guess
        )
        out[4, i] = e_new[i]


@njit(cache=True, error_model="numpy")
def _correct(rate, attach, n_0, dt, second_order, constants, e_old, e_new, state, out):  # type: ignore[no-untyped-def]
    for i in range(e_new.size):
        d = out[2, i] + out[3, i] * (e_new[i] - out[4, i])
        e_c, k, lam = state[0, i], state[1, i], state[2, i]
        value, slope, s, s_e, s_d, c_e = _imbalance(
            d, rate[i], attach[i], n_0[i], dt, second_order, constants, e_old[i], e_new[i], e_c, k, lam
        )
        change, increment_slope = -value / slope, c_e / slope
        out[0, i], out[1, i] = s + s_d * change, s_e + s_d * increment_slope
        out[2, i], out[3, i] = d + change, increment_slope
        out[4, i] = e_new[i]


@njit(cache=True, error_model="numpy")
def _advance(rate, attach, n_0, dt, second_order, constants, state, increment):  # type: ignore[no-untyped-def]
    new = np.empty_like(state)
    for i in range(increment.size):
        d, k, lam = increment[i], state[1, i], state[2, i]
        stiffness, mean, _, _, _, _ = bridges(
            d, rate[i], attach[i], n_0[i], dt, second_order, constants, k, lam
        )
        new[0, i] = state[0, i] + d
        new[1, i] = stiffness
        new[2, i] = 2.0 * mean - lam
        new[3, i] = d / dt
    return new

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
:math:`d = e_c^{n+1} - e_c^n` from the scalar equation of :mod:`heartfit.heart.muscle.fibre_equation`. The bridge energy
is :math:`\lambda_c^2/2`, that of the spring :math:`E_s e_s^2/2`; both balance exactly in every step, of any length. In
the second-order scheme, destruction acts on :math:`\bar r^2`, :math:`\bar r = (r^n + r^{n+1})/2`,

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
from heartfit.heart.muscle.fibre_equation import (
    BRIDGE_FLOOR,
    LARGEST_INCREMENT,
    bridges,
    fibre_response,
    fibre_step,
)
from heartfit.heart.muscle.spring import frozen_spring_slope, green_strain
from heartfit.heart.time_step import TimeStep

JOINT_STEPS = 4
"""Newton steps that all fibres take together; those that still move are then solved one by one, with a safeguard."""


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


@njit(cache=True, error_model="numpy")
def _respond(rate, attach, n_0, dt, second_order, constants, e_old, e_new, state, out):  # type: ignore[no-untyped-def]
    """Take Newton steps of all fibres at once while one needs them, then safeguarded steps of single fibres."""
    for _ in range(JOINT_STEPS):
        if _correct(rate, attach, n_0, dt, second_order, constants, e_old, e_new, state, out) == 0:
            return
    for i in range(e_new.size):
        e_c, k, lam = state[0, i], state[1, i], state[2, i]
        out[0, i], out[1, i], out[2, i], out[3, i] = fibre_response(
            rate[i],
            attach[i],
            n_0[i],
            dt,
            second_order,
            constants,
            e_old[i],
            e_new[i],
            e_c,
            k,
            lam,
            out[2, i],
        )


@njit(cache=True, error_model="numpy")
def _correct(rate, attach, n_0, dt, second_order, constants, e_old, e_new, state, out):  # type: ignore[no-untyped-def]
    """Take one Newton step of every fibre; return the number of those that are not solved."""
    unsolved = 0
    for i in range(e_new.size):
        guess = out[2, i] + out[3, i] * (e_new[i] - out[4, i])
        e_c, k, lam = state[0, i], state[1, i], state[2, i]
        out[0, i], out[1, i], out[2, i], out[3, i], solved = fibre_step(
            rate[i], attach[i], n_0[i], dt, second_order, constants, e_old[i], e_new[i], e_c, k, lam, guess
        )
        out[4, i] = e_new[i]
        unsolved += not solved
    return unsolved


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

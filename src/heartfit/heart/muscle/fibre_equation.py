"""Scalar equation of one fibre in one step of :mod:`heartfit.heart.muscle.bcs`, and its solution by Newton's method."""

import numpy as np
from numba import njit

from heartfit.heart.muscle.spring import spring_response

BRIDGE_FLOOR = 1.0
"""Smallest bridge stiffness k_c [Pa]: keeps sqrt(k_c) differentiable in a relaxed muscle."""

LARGEST_INCREMENT = 0.1
"""Largest change of e_c in a step: beyond it the scalar equation has spurious roots."""

STRAIN_TOLERANCE = 1e-8
"""Newton step in e_c that ends the iteration; the stress is then corrected to first order, E_s times its square being
below 1 Pa."""


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


@njit(cache=True, error_model="numpy", inline="always")
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
def fibre_step(rate, attach, n_0, dt, second_order, constants, e_old, e_new, e_c, k, lam, d):  # type: ignore[no-untyped-def]
    """Stress, its slope, increment and its slope after one Newton step from ``d``, and whether they are the solution.

    There are no calls, loops or exits, so that a loop over fibres is compiled to take several at once.
    """
    value, slope, s, s_e, s_d, c_e = _imbalance(
        d, rate, attach, n_0, dt, second_order, constants, e_old, e_new, e_c, k, lam
    )
    change, increment_slope = -value / slope, c_e / slope
    solved = slope > 0.0 and abs(change) < STRAIN_TOLERANCE and abs(d) < LARGEST_INCREMENT
    return s + s_d * change, s_e + s_d * increment_slope, d + change, increment_slope, solved


@njit(cache=True, error_model="numpy", inline="always")
def fibre_response(rate, attach, n_0, dt, second_order, constants, e_old, e_new, e_c, k, lam, d):  # type: ignore[no-untyped-def]
    """Solution of :func:`fibre_step`, by Newton's method from the guess ``d``, safeguarded by bisection."""
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

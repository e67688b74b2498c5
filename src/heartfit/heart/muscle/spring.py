"""Series element of the sarcomere: mean stresses of a step in rheology A (multiplicative) and B (additive)."""

import numpy as np
from numba import njit


@njit(cache=True, error_model="numpy", inline="always")
def frozen_spring_slope(additive, e, e_c):  # type: ignore[no-untyped-def]
    """Derivative of the strain of the sarcomere by that of the fibre, at a fixed strain of the spring."""
    return 1.0 / np.sqrt(1.0 + 2.0 * e) if additive else (1.0 + 2.0 * e_c) / (1.0 + 2.0 * e)


@njit(cache=True, error_model="numpy", inline="always")
def green_strain(additive, e_c):  # type: ignore[no-untyped-def]
    """Green-Lagrange strain of the sarcomere."""
    return e_c * (1.0 + 0.5 * e_c) if additive else e_c


@njit(cache=True, error_model="numpy", inline="always")
def spring_response(d, e_old, e_new, e_c, E_s, additive):  # type: ignore[no-untyped-def]
    """Fibre stress sigma# and contractile stress sigma_c# of the spring, both with their derivatives by e and d."""
    return (
        _additive_spring(d, e_old, e_new, e_c, E_s)
        if additive
        else _multiplicative_spring(d, e_old, e_new, e_c, E_s)
    )


@njit(cache=True, error_model="numpy", inline="always")
def _additive_spring(d, e_old, e_new, e_c, E_s):  # type: ignore[no-untyped-def]
    old, new = np.sqrt(1.0 + 2.0 * e_old), np.sqrt(1.0 + 2.0 * e_new)
    tension, tension_e, tension_d = (
        E_s * (0.5 * (old + new) - 1.0 - e_c - 0.5 * d),
        0.5 * E_s / new,
        -0.5 * E_s,
    )
    per = 2.0 / (old + new)
    s = tension * per
    return s, (tension_e - 0.5 * s / new) * per, tension_d * per, tension, tension_e, tension_d


@njit(cache=True, error_model="numpy", inline="always")
def _multiplicative_spring(d, e_old, e_new, e_c, E_s):  # type: ignore[no-untyped-def]
    es_old = (e_old - e_c) / (1.0 + 2.0 * e_c)
    es_e = 1.0 / (1.0 + 2.0 * (e_c + d))
    es_new = (e_new - e_c - d) * es_e
    es_d = -(1.0 + 2.0 * e_new) * es_e * es_e
    mean = 0.5 * (es_old + es_new)
    per_A, B = 1.0 / (1.0 + 2.0 * e_c + d), 1.0 + 2.0 * mean
    s = E_s * mean * per_A
    s_e, s_d = 0.5 * E_s * es_e * per_A, (0.5 * E_s * es_d - s) * per_A
    return s, s_e, s_d, s * B, B * s_e + s * es_e, B * s_d + s * es_d

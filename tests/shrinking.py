"""Check of derivatives: the error of central differences shrinks with the step until round-off."""

from collections.abc import Callable

import numpy as np

REFINEMENTS = 6
ORDER = 1.5
"""Central differences are of order 2; a wrong derivative is of order 0."""

ROUND_OFF = 1000.0 * np.finfo(float).eps


def assert_derivative(
    f: Callable[[np.ndarray], np.ndarray], derivative: np.ndarray, x: np.ndarray, direction: np.ndarray
) -> None:
    """``derivative`` is that of ``f`` at ``x`` along ``direction``, which is also the largest step taken.

    The direction must change ``f`` by far more than round-off and stay clear of its kinks.
    """
    errors, floors = [], []
    for h in 0.25 ** np.arange(REFINEMENTS):
        upper, lower = np.asarray(f(x + h * direction)), np.asarray(f(x - h * direction))
        errors.append(np.linalg.norm((upper - lower) / (2.0 * h) - derivative))
        floors.append(ROUND_OFF * (np.linalg.norm(upper) + np.linalg.norm(lower)) / h)
    assert floors[-1] < 1e-3 * np.linalg.norm(derivative), "the direction is too short to tell the derivative"
    for coarse, fine, floor in zip(errors, errors[1:], floors[1:], strict=False):
        assert fine <= max(coarse * 0.25**ORDER, floor), f"errors {errors} do not shrink, round-off {floors}"

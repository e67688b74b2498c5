r"""The maximum a posteriori by CMA-ES, which asks for no slope of the model.

Minimises, over u in standard deviations of the prior, X = X0 + C^(1/2) u,

.. math:: J(u) = |u|^2 + (Z(X) - z)^T R^{-1} (Z(X) - z);

a failed simulation counts as infinitely bad. Needs the package cma (BSD-3-Clause), the extra "alternatives".

Reference: Hansen 2016, arXiv:1604.00772.
"""

from collections.abc import Iterator, Mapping
from importlib.util import find_spec

import numpy as np

from heartfit.calibration.forward import Forward
from heartfit.calibration.gaussian import Gaussian
from heartfit.errors import InputError

FIRST_STEP = 0.5
"""Standard deviations of the prior."""


def installed() -> bool:
    """Whether the package is there."""
    return find_spec("cma") is not None


def evolved(
    prior: Gaussian, forward: Forward, observed: Mapping[str, float], noise: np.ndarray, seed: int
) -> Iterator[np.ndarray]:
    """The best point z (n,) so far after each generation, without end.

    noise: R (m, m), positive definite; seed: above 0. Raises InputError if cma is not installed.
    """
    if not installed():
        raise InputError("calibration: CMA-ES needs the package cma: pip install 'heartfit[alternatives]'")
    import cma

    root, weight = np.linalg.cholesky(prior.covariance), np.linalg.inv(noise)
    wanted, best, least = np.array(list(observed.values())), prior.mean, np.inf
    search = cma.CMAEvolutionStrategy(
        np.zeros(len(prior.names)), FIRST_STEP, {"seed": seed, "verbose": -9, "verb_log": 0}
    )
    while True:
        u = np.array(search.ask())
        x = prior.mean + u @ root.T
        outcomes = forward([prior.physical(point) for point in x])
        misfit = [
            np.inf
            if isinstance(outcome, str)
            else _square(np.array([outcome[name] for name in observed]) - wanted, weight)
            for outcome in outcomes
        ]
        cost = np.square(u).sum(axis=1) + misfit
        search.tell(list(u), cost.tolist())
        if cost.min() < least:
            best, least = x[cost.argmin()], cost.min()
        yield best


def _square(residual: np.ndarray, weight: np.ndarray) -> float:
    return float(residual @ weight @ residual)

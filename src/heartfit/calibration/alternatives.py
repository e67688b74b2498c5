r"""Other methods of calibration: iterated unscented transform, ensemble smoother, and CMA-ES.

**Iterated unscented transform.** The points of step k have the mean x_k, the last estimate, and the covariance P_k.
They give a linear model,

.. math:: Z \approx \bar Z_k + A_k (X - x_k) + e, \quad A_k = \mathrm{Cov}(Z, X) P_k^{-1}, \quad
          e \sim N(0,\, \mathrm{Cov}(Z, Z) - A_k P_k A_k^T) .

The next estimate is the posterior of this model and the original prior, not the last posterior: the data are used only
once. With R = 0 the fixed point reproduces the observations by the smallest prior-weighted change. With R > 0 it is the
maximum a posteriori of a Gauss-Newton method with statistical slopes. P_k = s^(2k) C shrinks by the factor s in each
step, so that the last slopes are those at the estimate. The first step equals
:func:`heartfit.calibration.update.calibrate` up to rounding.

References: Bell and Cathey 1993, doi:10.1109/9.250476; Garcia-Fernandez et al. 2015, doi:10.1109/TSP.2015.2454485.

**Ensemble smoother with multiple data assimilation (ES-MDA).** An ensemble drawn from the prior is moved towards the
observations a times, each time with the noise inflated by a,

.. math:: x_j \leftarrow x_j + C_{XZ} (C_{ZZ} + a R)^{-1} (z + \sqrt{a}\, R^{1/2} \epsilon_j - h(x_j)),

with the covariances of the ensemble. For a linear map and many members the result is the posterior. Members whose
simulation fails are omitted from then on.

Reference: Emerick and Reynolds 2013, doi:10.1016/j.cageo.2012.03.011.

**CMA-ES.** The maximum a posteriori without slopes of the model. It minimises, over u in standard deviations of the
prior, X = X0 + C^(1/2) u,

.. math:: J(u) = |u|^2 + (Z(X) - z)^T R^{-1} (Z(X) - z) .

The objective of a failed simulation is infinite. Needs the package cma (BSD-3-Clause), the extra "alternatives".

Reference: Hansen 2016, arXiv:1604.00772.
"""

from collections.abc import Iterator, Mapping
from importlib.util import find_spec

import numpy as np

from heartfit.calibration.design import CalibrationError, Design
from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import STANDARD_DESIGN, Forward, sigma_points
from heartfit.calibration.update import SHRINK, Posterior, calibrate, narrowed
from heartfit.core.errors import InputError


def iterate(
    prior: Gaussian,
    forward: Forward,
    observed: Mapping[str, float],
    noise: np.ndarray | None = None,
    design: Design = STANDARD_DESIGN,
    shrink: float = SHRINK,
    start: Gaussian | None = None,
) -> Iterator[Posterior]:
    """Yield the posteriors of steps 1, 2, ... without end, each from one simulation per point of the design.

    start: Gaussian of the points of the first step, the prior if None; its covariance is shrunk. Raises
    CalibrationError if too many points about an estimate fail.
    """
    first = around = prior if start is None else start
    spread = 1.0
    while True:
        outcomes = forward([point.parameters for point in sigma_points(around, design)])
        posterior = calibrate(prior, outcomes, observed, noise, design, around)
        yield posterior
        spread *= shrink
        around = narrowed(first, posterior.estimate.mean, spread)


def smooth_ensemble(
    prior: Gaussian,
    forward: Forward,
    observed: Mapping[str, float],
    noise: np.ndarray,
    members: int,
    seed: int,
    assimilations: int = 4,
) -> np.ndarray:
    """Return the ensemble (members, n) of logarithms after all assimilations, from members x assimilations simulations.

    noise: R (m, m), positive definite. Raises CalibrationError if fewer than three members remain.
    """
    rng = np.random.default_rng(seed)
    x = prior.mean + rng.standard_normal((members, len(prior.names))) @ np.linalg.cholesky(prior.covariance).T
    root = np.sqrt(assimilations) * np.linalg.cholesky(noise).T
    for _ in range(assimilations):
        x, z = _simulate_members(prior, x, forward, tuple(observed))
        wanted = np.array(list(observed.values())) + rng.standard_normal(z.shape) @ root
        dx, dz = x - x.mean(axis=0), z - z.mean(axis=0)
        total = dz.T @ dz / (len(x) - 1) + root.T @ root
        x = x + (wanted - z) @ np.linalg.solve(total, dz.T @ dx / (len(x) - 1))
    return x


def _simulate_members(
    prior: Gaussian, x: np.ndarray, forward: Forward, names: tuple[str, ...]
) -> tuple[np.ndarray, np.ndarray]:
    """Return the members with a completed simulation, and their observations."""
    outcomes = forward([prior.physical(member) for member in x])
    completed = [not isinstance(outcome, str) for outcome in outcomes]
    if sum(completed) < 3:
        raise CalibrationError(
            f"calibration: {sum(completed)} of {len(x)} members of the ensemble remain; expected 3: narrow the prior"
        )
    z = [[outcome[name] for name in names] for outcome in outcomes if not isinstance(outcome, str)]
    return x[completed], np.array(z)


FIRST_STEP = 0.5
"""Initial step [prior standard deviations]."""


def has_cma() -> bool:
    """Return True if the package cma is installed."""
    return find_spec("cma") is not None


def minimise_by_cma_es(
    prior: Gaussian, forward: Forward, observed: Mapping[str, float], noise: np.ndarray, seed: int
) -> Iterator[np.ndarray]:
    """Yield the best point z (n,) so far after each generation, without end.

    noise: R (m, m), positive definite; seed: above 0. Raises InputError if cma is not installed.
    """
    if not has_cma():
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

r"""An ensemble smoother with multiple data assimilation (ES-MDA).

An ensemble drawn from the prior is moved a times towards the observations, each time with noise inflated by a,

.. math:: x_j \leftarrow x_j + C_{XZ} (C_{ZZ} + a R)^{-1} (z + \sqrt{a}\, R^{1/2} \epsilon_j - h(x_j)),

with the covariances of the ensemble: on a linear map and with many members that is the posterior. Members whose
simulation fails are left out from there on.

Reference: Emerick and Reynolds 2013, doi:10.1016/j.cageo.2012.03.011.
"""

from collections.abc import Mapping

import numpy as np

from heartfit.calibration.design import CalibrationError
from heartfit.calibration.forward import Forward
from heartfit.calibration.gaussian import Gaussian


def smoothed(
    prior: Gaussian,
    forward: Forward,
    observed: Mapping[str, float],
    noise: np.ndarray,
    members: int,
    seed: int,
    assimilations: int = 4,
) -> np.ndarray:
    """The ensemble (members, n) of logarithms after all assimilations, at members x assimilations simulations.

    noise: R (m, m), positive definite. Raises CalibrationError if fewer than three members are left.
    """
    rng = np.random.default_rng(seed)
    x = prior.mean + rng.standard_normal((members, len(prior.names))) @ np.linalg.cholesky(prior.covariance).T
    root = np.sqrt(assimilations) * np.linalg.cholesky(noise).T
    for _ in range(assimilations):
        x, z = _seen(prior, x, forward, tuple(observed))
        wanted = np.array(list(observed.values())) + rng.standard_normal(z.shape) @ root
        dx, dz = x - x.mean(axis=0), z - z.mean(axis=0)
        total = dz.T @ dz / (len(x) - 1) + root.T @ root
        x = x + (wanted - z) @ np.linalg.solve(total, dz.T @ dx / (len(x) - 1))
    return x


def _seen(
    prior: Gaussian, x: np.ndarray, forward: Forward, names: tuple[str, ...]
) -> tuple[np.ndarray, np.ndarray]:
    """The members whose simulation is completed, and what is observed of them."""
    outcomes = forward([prior.physical(member) for member in x])
    done = [not isinstance(outcome, str) for outcome in outcomes]
    if sum(done) < 3:
        raise CalibrationError(
            f"calibration: {sum(done)} of {len(x)} members of the ensemble are left; expected 3: narrow the prior"
        )
    z = [[outcome[name] for name in names] for outcome in outcomes if not isinstance(outcome, str)]
    return x[done], np.array(z)

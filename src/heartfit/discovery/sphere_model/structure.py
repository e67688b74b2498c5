r"""Structural discrepancy: what the sphere leaves of a beat that another simulator, or nature, has made.

A discrepancy is a curve over the phase of the beat, of the left volume and pressure jointly. The sphere leaves the
residuals r_n of N healthy hearts of other simulators, or of a group of controls:

.. math:: S(\phi, \phi') = (1 - \lambda) \frac{1}{N} \sum_n r_n(\phi) r_n(\phi')
          + \lambda\, \sigma(\phi) \sigma(\phi') \rho(\phi - \phi'), \quad
          \sigma^2(\phi) = \frac{1}{N} \sum_n r_n^2(\phi) ,

of mean zero: what the next simulator leaves has no known sign. The second term shrinks S towards the same variances
with a smooth correlation rho within each curve, because a few hearts span a few directions only.

References: Kennedy and O'Hagan 2001, doi:10.1111/1467-9868.00294; Ledoit and Wolf 2004,
doi:10.1016/S0047-259X(03)00096-4.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import block_diag

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.inference.data import STRUCTURE_SCALES
from heartfit.discovery.sphere_model.landmarks import CURVES, PHASES
from heartfit.discovery.sphere_model.nominal_heart import PEOPLE
from heartfit.discovery.sphere_model.problem import SphereProblem
from heartfit.discovery.sphere_model.recording import Recording

SHRINKAGE, CORRELATION = 0.5, 0.06
"""lambda, and the standard deviation of rho, a Gaussian of the phase."""


@dataclass(frozen=True, eq=False)
class Structure:
    """Covariance (2 PHASES, 2 PHASES) of a discrepancy over the phases of both curves, of mean zero."""

    covariance: Floats

    @classmethod
    def from_residuals(cls, residuals: Floats) -> "Structure":
        """Learn from residuals (N, 2 PHASES) of healthy hearts."""
        empirical = residuals.T @ residuals / residuals.shape[0]
        sd = np.sqrt(np.diag(empirical))
        lags = np.abs(np.subtract.outer(np.arange(PHASES), np.arange(PHASES))) / PHASES
        correlation = np.exp(-0.5 * (np.minimum(lags, 1.0 - lags) / CORRELATION) ** 2)
        target = np.outer(sd, sd) * block_diag(correlation, correlation)
        return cls((1.0 - SHRINKAGE) * empirical + SHRINKAGE * target)

    def enter(self, problem: SphereProblem) -> SphereProblem:
        """Return the problem whose data may hold the discrepancy, at scales that are equally likely."""
        weights = problem.frame.weights(problem.data.blocks)
        covariance = weights @ self.covariance @ weights.T
        return replace(problem, data=replace(problem.data, structure=covariance, scales=STRUCTURE_SCALES))


def healthy_residual(recording: Recording) -> Floats:
    """Return what the sphere leaves of a healthy heart, (2 PHASES,); raises InputError without volume and pressure."""
    missing = [curve for curve in CURVES if curve not in recording.curves]
    if missing:
        raise InputError(
            f"reference: no {' and '.join(missing)}; expected volume and pressure of every control"
        )
    problem = SphereProblem.from_recording(recording, PEOPLE.scaled_to(recording))
    left = problem.data.values - problem.fit().fit.predicted
    return problem.frame.residual(problem.data.blocks, [left[rows] for rows in problem.data.rows])


def learn_from_controls(controls: Mapping[str, Recording]) -> Structure:
    """Return the structure of what the sphere leaves of controls, by name; raises InputError that names a control."""
    residuals = []
    for name, recording in controls.items():
        try:
            residuals.append(healthy_residual(recording))
        except InputError as error:
            raise InputError(f"{name}: {error}") from error
    return Structure.from_residuals(np.array(residuals))

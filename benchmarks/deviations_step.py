"""One unscented step on logarithms, as the study takes it, and on the parameters themselves, as the paper writes it.

On the additive scale z = theta / theta_0 with mean 1 and the same relative standard deviations. Everything else,
from the weights to the update, is the same code.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from heartfit.calibration.design import CalibrationError, Design
from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import STANDARD_DESIGN, Forward, Outcome, sigma_points
from heartfit.calibration.update import calibrate

LOGARITHMIC, ADDITIVE = "logarithmic", "additive"
NEGATIVE = "a parameter is not positive"
"""Reason of a point that no heart has."""


@dataclass(frozen=True, eq=False)
class Step:
    """Estimate [SI] by name, its longest move [prior standard deviations], and the number of impossible sigma points.

    The estimate is empty where the step is impossible or ends at a parameter that is not positive.
    """

    estimate: Mapping[str, float]
    longest: float
    impossible: int


def widened(prior: Gaussian, factor: float) -> Gaussian:
    """The prior with its standard deviations multiplied."""
    return replace(prior, covariance=factor**2 * prior.covariance)


def take_step(
    prior: Gaussian,
    forward: Forward,
    observed: Mapping[str, float],
    scale: str,
    design: Design = STANDARD_DESIGN,
) -> Step:
    """Estimate after one step that meets the observations exactly, R = 0."""
    on_scale = replace(prior, mean=np.ones(len(prior.names))) if scale == ADDITIVE else prior
    points = [_parameters(prior, point.z, scale) for point in sigma_points(on_scale, design)]
    impossible = sum(_is_impossible(point) for point in points)
    try:
        posterior = calibrate(on_scale, _simulate(forward, points), observed, None, design)
    except CalibrationError:
        return Step({}, np.nan, impossible)
    estimate = _parameters(prior, posterior.estimate.mean, scale)
    longest = float(np.abs(posterior.step).max())
    return Step({} if _is_impossible(estimate) else estimate, longest, impossible)


def _parameters(prior: Gaussian, z: np.ndarray, scale: str) -> dict[str, float]:
    if scale == LOGARITHMIC:
        return prior.physical(z)
    return {
        name: median * float(share) for (name, median), share in zip(prior.physical().items(), z, strict=True)
    }


def _is_impossible(parameters: Mapping[str, float]) -> bool:
    return min(parameters.values()) <= 0.0


def _simulate(forward: Forward, points: list[dict[str, float]]) -> list[Outcome]:
    """Outcomes of the points; an impossible one fails without a simulation."""
    outcomes = iter(forward([point for point in points if not _is_impossible(point)]))
    return [NEGATIVE if _is_impossible(point) else next(outcomes) for point in points]

"""Kalman update of the prior by the observations.

    G = Cov(X, Z) (Cov(Z, Z) + R)^-1,   X_new = X0 + G (Z_obs - Zbar),   C_post = C - G (Cov(Z, Z) + R) G^T

With R = 0 this is eq. (3) of Marchesseau et al. 2012. For a linear map it reproduces the observations exactly and,
with more parameters than observations, by the change of least prior-weighted norm. Directions without information keep
their prior.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from heartfit.calibration.design import Design
from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import (
    STANDARD_DESIGN,
    CalibrationError,
    Moments,
    SigmaPoint,
    sigma_points,
    transform,
)

LONG_STEP = 2.5
"""Prior standard deviations beyond which a step is long. The points of four and of seven parameters are sqrt(4) = 2 and
sqrt(7) = 2.65 of them from the centre: farther out no simulation supports the linear map, and the prior expects one
estimate in eighty."""
SILENT_VARIATION = 1e-8  # relative standard deviation of an observation that is only rounding
COLLINEAR_EIGENVALUE = (
    1e-10  # largest eigenvalue of the normalised covariance of the observations that counts as zero
)
ROUNDING = (
    1e-6  # largest negative variance, over the prior's, due to rounding in the inverse of that covariance
)
NEGATIVE_VARIANCE = (
    "calibration: the {what} over the sigma points is negative, as a negative weight of the centre allows: "
    "take a <= 1 and kappa such that a^2 (n + kappa) >= n"
)


@dataclass(frozen=True)
class Posterior:
    """Result of an update; all parameters are logarithms.

    prior, estimate: mean and covariance before and after; observed (m,) Z_obs; predicted (m,) Zbar; gain (n, m);
    cov_xz (n, m); cov_zz (m, m) without R; step (n,) in prior standard deviations; sensitivity (n, m) is
    Cov(X, Z) with rows divided by sd_X and columns by sd_Z, and singular_values are its singular values, by which the
    paper selects parameters; failed: sigma points without a beat, with reasons.
    """

    prior: Gaussian
    estimate: Gaussian
    observations: tuple[str, ...]
    observed: np.ndarray
    predicted: np.ndarray
    gain: np.ndarray
    cov_xz: np.ndarray
    cov_zz: np.ndarray
    step: np.ndarray
    sensitivity: np.ndarray
    singular_values: np.ndarray
    failed: tuple[str, ...]
    notes: tuple[str, ...]


def calibrate(
    prior: Gaussian,
    outcomes: Sequence[Mapping[str, float] | str],
    observed: Mapping[str, float],
    noise: np.ndarray | None = None,
    design: Design = STANDARD_DESIGN,
    around: Gaussian | None = None,
) -> Posterior:
    """Return the posterior from the outcome of each sigma point: its observations, or the reason of its failure.

    around: Gaussian of the points in a later iteration, see
    :func:`heartfit.calibration.alternatives.iterate`; by default that of the prior.
    """
    if around is None:
        return update(prior, moments_of(prior, outcomes, tuple(observed), design), observed, noise)
    moments = moments_of(around, outcomes, tuple(observed), design)
    return update(prior, under_prior(prior, around, moments), observed, noise, around.mean)


SHRINK = 0.5
"""Factor of the standard deviations of the points from one iteration to the next: slopes near the estimate."""


def narrowed(prior: Gaussian, estimate: np.ndarray, factor: float = SHRINK) -> Gaussian:
    """Return the Gaussian of the points of a later iteration: at an estimate (n,), deviations times ``factor``."""
    return Gaussian(prior.names, estimate, factor**2 * prior.covariance)


def under_prior(prior: Gaussian, around: Gaussian, moments: Moments) -> Moments:
    """Return the moments under the prior of the linear model from ``moments``, which are those under ``around``."""
    slope = np.linalg.solve(around.covariance, moments.cov_xz)
    bent = moments.cov_zz - slope.T @ around.covariance @ slope
    cov_xz = prior.covariance @ slope
    mean = moments.mean + (prior.mean - around.mean) @ slope
    return Moments(mean, cov_xz, slope.T @ cov_xz + bent, moments.failed)


def moments_of(
    prior: Gaussian,
    outcomes: Sequence[Mapping[str, float] | str],
    names: Sequence[str],
    design: Design = STANDARD_DESIGN,
) -> Moments:
    """Return the moments of the observations `names` from the outcome of each sigma point."""
    points = sigma_points(prior, design)
    if len(outcomes) != len(points):
        raise ValueError(
            f"calibration: {len(outcomes)} outcomes; expected one for each of {len(points)} points"
        )
    named = [_with_reason(point, outcome) for point, outcome in zip(points, outcomes, strict=True)]
    z = np.array([_row(outcome, tuple(names)) for outcome in outcomes])
    completed = np.array([not isinstance(outcome, str) for outcome in outcomes])
    return transform(named, z, design, completed)


def _with_reason(point: SigmaPoint, outcome: Mapping[str, float] | str) -> SigmaPoint:
    return replace(point, label=f"{point.label} ({outcome})") if isinstance(outcome, str) else point


def _row(outcome: Mapping[str, float] | str, names: tuple[str, ...]) -> list[float]:
    if isinstance(outcome, str):
        return [np.nan] * len(names)
    if missing := [name for name in names if name not in outcome]:
        raise KeyError(
            f"calibration: an outcome has no {', '.join(missing)}, which is observed; expected the observations of "
            "every point: observe simulations and data alike"
        )
    return [outcome[name] for name in names]


def update(
    prior: Gaussian,
    moments: Moments,
    observed: Mapping[str, float],
    noise: np.ndarray | None = None,
    start: np.ndarray | None = None,
) -> Posterior:
    """Return the posterior given `observed` (by name, in the order of the moments' columns).

    noise: R (m, m) in the observations' units, zero if None (the paper); start (n,): where the points of a later
    iteration lie, from which the notes count a long step, the prior's mean by default. Raises CalibrationError if an
    observation does not respond to any parameter, if the observations are collinear over the prior, or if a
    scaling with a negative weight makes a covariance negative.
    """
    names, z = tuple(observed), np.array(list(observed.values()))
    scale = _scale(moments, names)
    noise = None if noise is None else _require_covariance(noise, names)
    correlation = _normalise(moments.cov_zz, noise, scale)
    _require_definite(correlation, names)
    gain = np.linalg.solve(correlation, (moments.cov_xz / scale).T).T / scale
    shift = gain @ (z - moments.mean)
    covariance = prior.covariance - (gain * scale) @ correlation @ (gain * scale).T
    step = shift / prior.sd
    sensitivity = moments.cov_xz / np.outer(prior.sd, scale)
    return Posterior(
        prior,
        Gaussian(prior.names, prior.mean + shift, _make_positive(covariance, prior.covariance)),
        names,
        z,
        moments.mean,
        gain,
        moments.cov_xz,
        moments.cov_zz,
        step,
        sensitivity,
        np.linalg.svd(sensitivity, compute_uv=False),
        moments.failed,
        (
            *_failures(moments.failed),
            *_excess(len(prior.names), names, noise),
            *_long_steps(prior.names, step if start is None else (prior.mean + shift - start) / prior.sd),
        ),
    )


def _require_covariance(noise: np.ndarray, names: tuple[str, ...]) -> np.ndarray:
    """Return the noise as an array; raise CalibrationError unless it is a covariance of the observations."""
    covariance, m = np.asarray(noise, dtype=float), len(names)
    if covariance.shape != (m, m):
        raise CalibrationError(
            f"calibration: noise has the shape {covariance.shape}; expected ({m}, {m}), the covariance of "
            f"{', '.join(names)}: of independent standard deviations it is numpy.diag(sd**2)"
        )
    return covariance


def _scale(moments: Moments, names: tuple[str, ...]) -> np.ndarray:
    variance = np.diag(moments.cov_zz)
    if variance.shape != (len(names),):
        raise ValueError(f"calibration: {len(names)} observations {names}, {variance.size} columns predicted")
    silent = [
        name
        for name, quiet in zip(names, variance <= (SILENT_VARIATION * moments.mean) ** 2, strict=True)
        if quiet
    ]
    if (variance < 0).any():
        raise CalibrationError(NEGATIVE_VARIANCE.format(what=f"variance of {', '.join(silent)}"))
    if silent:
        raise CalibrationError(f"calibration: no parameter changes {', '.join(silent)}: do not observe it")
    return np.sqrt(variance)


def _normalise(cov_zz: np.ndarray, noise: np.ndarray | None, scale: np.ndarray) -> np.ndarray:
    total = cov_zz if noise is None else cov_zz + noise
    return total / np.outer(scale, scale)


def _require_definite(correlation: np.ndarray, names: tuple[str, ...]) -> None:
    smallest = float(np.linalg.eigvalsh(correlation).min())
    if smallest < -COLLINEAR_EIGENVALUE:
        raise CalibrationError(NEGATIVE_VARIANCE.format(what=f"covariance of {', '.join(names)}"))
    if smallest < COLLINEAR_EIGENVALUE:
        raise CalibrationError(
            f"calibration: {', '.join(names)} are collinear over the prior (smallest eigenvalue {smallest:.1e} of "
            "their normalised covariance): observe fewer, estimate more parameters, or give the observations noise"
        )


def _make_positive(covariance: np.ndarray, prior: np.ndarray) -> np.ndarray:
    """Symmetrise; raise variances that vanish up to rounding to 1e-12 of the mean prior variance."""
    values, vectors = np.linalg.eigh((covariance + covariance.T) / 2)
    variance = np.trace(prior) / len(prior)
    if values.min() < -ROUNDING * variance:
        raise CalibrationError(NEGATIVE_VARIANCE.format(what="covariance of the posterior"))
    floor = 1e-12 * variance
    return (vectors * np.maximum(values, floor)) @ vectors.T


def _failures(failed: tuple[str, ...]) -> list[str]:
    text = (
        f"failed sigma points: {', '.join(failed)}; weights rescaled over the rest, exact for a linear model"
    )
    return [text] if failed else []


def _excess(parameters: int, names: tuple[str, ...], noise: np.ndarray | None) -> list[str]:
    """Warn about more observations than parameters without noise: only the map's curvature determines the surplus."""
    if noise is not None or len(names) <= parameters:
        return []
    return [
        f"{len(names)} observations for {parameters} parameters without noise: not to be met exactly, and the step "
        "is ill-posed: estimate more parameters or give the observations noise"
    ]


def long_steps(names: Sequence[str], step: np.ndarray | Sequence[float]) -> dict[str, float]:
    """Return the steps beyond ``LONG_STEP`` [prior standard deviations] by parameter."""
    return {name: float(size) for name, size in zip(names, step, strict=True) if abs(size) > LONG_STEP}


def _long_steps(names: Sequence[str], step: np.ndarray) -> list[str]:
    return [
        f"{name} moved by {size:+.1f} prior standard deviations: beyond {LONG_STEP:g} the prediction is "
        "extrapolated"
        for name, size in long_steps(names, step).items()
    ]

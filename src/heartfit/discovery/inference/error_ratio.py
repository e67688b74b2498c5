r"""Ratio of the errors of two models on the same samples, with an interval that knows of their correlations.

Both errors share the noise of the samples. With the correlation r between them and independent samples, Pitman and
Morgan's test of equal variances [1, 2] turns into the interval of the ratio of mean squares

.. math:: \hat\lambda \, (K \pm \sqrt{K^2 - 1}), \quad K = 1 + 2 (1 - r^2) \, t_\nu^2 / \nu ,

of the level of Student's t with :math:`\nu` degrees of freedom. Errors of neighbouring samples are alike: with the
correlation :math:`\rho^{|t_i - t_j|}` in time, T samples are worth :math:`T^2 / \sum_{ij} \rho^{2 |t_i - t_j|}`
independent ones [3], and :math:`\nu` is one less. The likelihood of both errors as one first-order autoregression tells
which correlations are plausible, and the worth is averaged over them. Curves of several segments are worth
:math:`(tr B)^2 / tr B^2` of each other, with the covariance B of their errors [4].

References: [1] Pitman 1939, doi:10.1093/biomet/31.1-2.9; [2] Morgan 1939, doi:10.1093/biomet/31.1-2.13; [3] Bartlett
1935, doi:10.2307/2342284; [4] Satterthwaite 1946, doi:10.2307/3002019.
"""

import numpy as np
from scipy.special import stdtrit

from heartfit.core.arrays import Floats

LEVEL = 0.95
"""Probability with which an interval holds the ratio."""
CORRELATIONS = np.linspace(0.0, 0.95, 20)
"""Correlations of errors that are one step of time apart."""
PRIOR = (1.0 - CORRELATIONS) ** 2
"""Their prior density, up to a factor. With a flat one, intervals of a dozen samples are too wide and hold 98 %."""
FEWEST_DEGREES = 1.0


def error_ratio(times: Floats, baseline: Floats, extended: Floats) -> tuple[float, tuple[float, float]]:
    """Ratio of the root mean square errors (k,), extended over baseline, and its 95 % interval.

    times (k,): of the samples, in any unit; samples of the same time are those of different segments, in one order.
    """
    steps = np.unique(times)
    order = np.argsort(times, kind="stable")
    errors = np.array([error[order].reshape(steps.size, -1) for error in (baseline, extended)])
    squares = np.maximum(np.mean(errors**2, axis=(1, 2)), np.finfo(float).tiny)
    ratio = float(np.sqrt(squares[1] / squares[0]))
    shape = errors / np.sqrt(squares)[:, None, None]
    degrees = max(_independent_samples(steps, shape) - 1.0, FEWEST_DEGREES)
    shared = min(float(np.mean(shape[0] * shape[1])) ** 2, 1.0)
    k = 1.0 + 2.0 * (1.0 - shared) * stdtrit(degrees, 0.5 + 0.5 * LEVEL) ** 2 / degrees
    reach = float(np.sqrt(k + np.sqrt(k**2 - 1.0)))
    return ratio, (ratio / reach, ratio * reach)


def _independent_samples(steps: Floats, errors: Floats) -> float:
    """Number of independent samples that errors (2, t, segments) of unit mean square are worth."""
    lags = np.abs(steps[:, None] - steps) / np.median(np.diff(steps))
    shares = np.mean(CORRELATIONS[:, None, None] ** (2.0 * lags), axis=(1, 2))
    segments = _independent_segments(errors)
    likelihood = _log_likelihoods(np.diagonal(lags, 1), errors)
    weight = PRIOR * np.exp(segments * (likelihood - likelihood.max()))
    return segments / float(weight @ shares / weight.sum())


def _log_likelihoods(lags: Floats, errors: Floats) -> Floats:
    """ln likelihood (c,) of errors (2, t, segments) for each segment, by correlation, with the best covariance."""
    kept = CORRELATIONS[:, None] ** lags
    loss = 1.0 - kept**2
    changes = errors[:, 1:] - kept[:, None, :, None] * errors[:, :-1]
    innovations = np.einsum("cats,cbts,ct->cab", changes, changes, 1.0 / loss, optimize=True)
    covariance = (errors[:, 0] @ errors[:, 0].T + innovations) / errors[0].size
    determinant = np.maximum(np.linalg.det(covariance), np.finfo(float).tiny)
    likelihoods: Floats = -0.5 * errors.shape[1] * np.log(determinant) - np.log(loss).sum(axis=1)
    return likelihoods


def _independent_segments(errors: Floats) -> float:
    """Number of independent segments that those of errors (2, t, segments) are worth, without the bias of few times."""
    _, times, segments = errors.shape
    covariance = np.einsum("ats,atr->sr", errors, errors) / (2.0 * times)
    trace, square = np.trace(covariance), np.sum(covariance**2)
    unbiased = (square - trace**2 / times) / (1.0 + 1.0 / times)
    return float(np.clip(trace**2 / max(unbiased, trace**2 / segments), 1.0, segments))

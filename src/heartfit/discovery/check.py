r"""The evidence of one fit by importance sampling, to catch a Laplace approximation that misleads.

.. math:: Z = \frac1N \sum_i \frac{p(y \mid x_i)\, p(x_i)}{q(x_i)}, \qquad x_i \sim q,

q being Student's t with the posterior's mean and covariance: its tails are heavier than the posterior's, so that no
weight is unbounded. Draws that break a bound and simulations that fail count as zero.

References: Geweke 1989, doi:10.2307/1913710.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular
from scipy.special import gammaln, logsumexp, softmax

from heartfit.discovery.data import Data
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.whitening import Whitening
from heartfit.geometry.arrays import Floats

FREEDOM = 6.0
"""Degrees of freedom of the proposal."""


@dataclass(frozen=True)
class Sampled:
    """ln Z with its standard error, and of how many independent draws the weights are worth."""

    log_evidence: float
    error: float
    effective: float


def sampled(explanation: Explanation, data: Data, draws: int = 2000, seed: int = 0) -> Sampled:
    """The evidence of an explanation from as many simulations as draws.

    The first half of the draws follow the posterior of the fit, the second the weighted moments of the first, and only
    the second count.
    """
    random, whitening = np.random.default_rng(seed), Whitening.of(data)

    def weighed(mean: Floats, covariance: Floats) -> tuple[Floats, Floats]:
        x, log_q = _proposals(mean, covariance, draws // 2, random)
        return x, np.array([_log_joint(explanation, data, whitening, each) for each in x]) - log_q

    x, weights = weighed(explanation.posterior.mean, explanation.posterior.covariance)
    _, weights = weighed(*_moments(x, softmax(weights), explanation.posterior.covariance))
    effective = float(np.exp(2.0 * logsumexp(weights) - logsumexp(2.0 * weights)))
    error = float(np.sqrt(max(1.0 / effective - 2.0 / draws, 0.0)))
    return Sampled(float(logsumexp(weights) - np.log(weights.size)), error, effective)


def _moments(x: Floats, weights: Floats, covariance: Floats) -> tuple[Floats, Floats]:
    """Weighted mean and covariance of the draws, the latter mixed with that of the fit as far as they are few."""
    mean = weights @ x
    seen = (x - mean).T @ (weights[:, None] * (x - mean))
    share = 1.0 / (1.0 + x.shape[1] * np.sum(weights**2))
    return mean, share * seen + (1.0 - share) * covariance


def _proposals(
    mean: Floats, covariance: Floats, draws: int, random: np.random.Generator
) -> tuple[Floats, Floats]:
    """Draws (N, d) of the t distribution and the logarithms (N,) of its density."""
    factor, d = np.linalg.cholesky(covariance), mean.size
    stretch = np.sqrt(FREEDOM / random.chisquare(FREEDOM, draws))
    x = mean + stretch[:, None] * (random.standard_normal((draws, d)) @ factor.T)
    distance = np.sum(solve_triangular(factor, (x - mean).T, lower=True) ** 2, axis=0)
    peak = gammaln(0.5 * (FREEDOM + d)) - gammaln(0.5 * FREEDOM) - 0.5 * d * np.log(FREEDOM * np.pi)
    peak -= np.log(np.diag(factor)).sum()
    return x, peak - 0.5 * (FREEDOM + d) * np.log1p(distance / FREEDOM)


def _log_joint(explanation: Explanation, data: Data, whitening: Whitening, x: Floats) -> float:
    """ln p(y | x) p(x)."""
    hypothesis = explanation.fit.hypothesis
    predicted = hypothesis.forward(x) if (x >= hypothesis.lower).all() else None
    if predicted is None:
        return -np.inf
    prior = hypothesis.one_sided.sum() * np.log(2.0) - 0.5 * (x @ x + x.size * np.log(2.0 * np.pi))
    return float(prior + whitening.log_likelihood(data.values - predicted))

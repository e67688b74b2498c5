r"""The fit of a hypothesis, its evidence by Laplace's approximation, and intervals of its coordinates.

The fit minimises :math:`-\ln p(y - f(x)) + \tfrac12 |x|^2` over x, one-sided coordinates not negative; see
:mod:`heartfit.discovery.inference.descent` for the steps. A fit is converged when no step with fresh slopes predicts to
change the objective by 0.05 and the undamped one, which the simulation's roughness may refuse, not by 1.

Laplace's approximation of the evidence is exact for a linear model. About any point x, with the residual r = y
- f(x) and the Jacobian J, a linear model has the posterior N(m, H^-1),

.. math:: H = I + J^T \Sigma^{-1} J, \quad m = x + H^{-1} g, \quad g = J^T \Sigma^{-1} r - x,

.. math:: \ln Z = \ln N(r; 0, \Sigma) - \tfrac12 |x|^2 + \tfrac12 g^T H^{-1} g - \tfrac12 \ln |H|
          + \ln 2^k P(a \ge 0),

the last term for the k one-sided coordinates a: the share of the posterior within their bounds, see
:mod:`heartfit.discovery.inference.orthant`, at most a factor 2 of each. An amplitude held at 0 by its bound has
m_a < 0, a posterior that the bound cuts to its tail. Z is averaged over the levels of the noise.

References: Kass and Raftery 1995, doi:10.1080/01621459.1995.10476572.
"""

from dataclasses import dataclass, field
from functools import reduce

import numpy as np
from scipy.special import log_ndtr, logsumexp, ndtr, ndtri

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.data import Whitening
from heartfit.discovery.inference.descent import EXPENSIVE, Descent, InverseProblem, Schedule
from heartfit.discovery.inference.hypothesis import CountedHypothesis, Hypothesis
from heartfit.discovery.inference.orthant import log_share

SIMULATION_LIMIT = 600
"""Simulations after which a fit is given up: three times the number that most fits from the prior mean take."""
STEP_TOLERANCE = 0.02
"""[prior standard deviations]: a smaller step changes no reported number."""
OBJECTIVE_TOLERANCE = 0.05
"""[ln Z]: a fortieth of the least difference that a verdict rests on."""
LEAST_DAMPING = 1.0
"""With a tenth of it, steps that are too long leave a curved valley, and fits stop short of its floor."""
JACOBIAN_REFRESH = 2
"""Steps after which the Jacobian is renewed."""
SCHEDULE = Schedule(
    OBJECTIVE_TOLERANCE, LEAST_DAMPING, STEP_TOLERANCE, jacobian_refresh=JACOBIAN_REFRESH, full_near_end=True
)
"""Simulations are cheap: the Jacobian is renewed often."""


@dataclass(frozen=True, eq=False)
class Fit:
    """The end of one minimisation: x (d,), predicted (n,), jacobian (n, d) and the objective.

    kink: of a settled fit, the slope (d,) of the objective that no step could follow; empty of another one.
    """

    hypothesis: Hypothesis
    x: Floats
    predicted: Floats
    jacobian: Floats
    objective: float
    converged: bool
    kink: Floats = field(default_factory=lambda: np.empty(0))

    @property
    def settled(self) -> bool:
        """True if the fit ended with mean slopes."""
        return self.kink.size > 0

    @classmethod
    def at_end(cls, hypothesis: Hypothesis, descent: Descent) -> "Fit":
        """The state of a descent as a fit."""
        return cls(
            hypothesis,
            descent.x,
            descent.predicted,
            descent.jacobian,
            descent.objective,
            descent.converged,
        )


def fit(
    model: CountedHypothesis,
    values: Floats,
    whitening: Whitening,
    start: Floats,
    slopes: Floats | None = None,
    trusted: int = 0,
    target: float = np.inf,
    limit: int = SIMULATION_LIMIT,
) -> Fit | None:
    """The local minimum reached from ``start`` (d,); None where no simulation about it is completed.

    values: the data (n,); slopes: an initial Jacobian (n, d), by finite differences if None, whose first ``trusted``
    columns only Broyden updates; target: an objective; the fit is given up where fresh slopes predict to stay above it.
    """
    first = model.simulate_start(start)
    if first is None:
        return None
    jacobian = model.jacobian(*first) if slopes is None else slopes
    problem = InverseProblem(model, values, whitening, model.hypothesis.lower)

    def differences(x: Floats, predicted: Floats, old: Floats) -> Floats:
        return np.column_stack([old[:, :trusted], model.jacobian(x, predicted, trusted)])

    descent = Descent(problem, SCHEDULE, *first, jacobian, differences, slopes is None, target)
    while not descent.ended and model.runs < limit:
        descent.advance()
    return Fit.at_end(model.hypothesis, descent)


def fit_from_slopes(
    model: CountedHypothesis,
    values: Floats,
    whitening: Whitening,
    x: Floats,
    predicted: Floats,
    jacobian: Floats,
    most: int,
) -> Fit:
    """The end of at most ``most`` steps from x (d,), at which predicted (n,) and slopes ``jacobian`` (n, d) hold.

    For expensive simulations: a step costs one, and Broyden's update alone corrects the slopes.
    """
    problem = InverseProblem(model, values, whitening, model.hypothesis.lower)
    descent = Descent(problem, EXPENSIVE, x, predicted, jacobian)
    descent.run(most)
    return Fit.at_end(model.hypothesis, descent)


@dataclass(frozen=True, eq=False)
class LaplacePosterior:
    """ln Z, and the Gaussian N(mean (d,), covariance (d, d)) of the coordinates before any bound cuts it."""

    log_evidence: float
    mean: Floats
    covariance: Floats


def posterior(
    whitening: Whitening,
    x: Floats,
    residual: Floats,
    jacobian: Floats,
    one_sided: np.ndarray,
    kink: Floats | float = 0.0,
) -> LaplacePosterior:
    """The posterior of the model that is linear about x: coordinates (d,), residual (n,), Jacobian (n, d).

    kink (d,): a slope that x has but the model about it has not.
    """
    gram, peak = _level_combinations(whitening, residual, jacobian)
    covariance = np.asarray(np.linalg.inv(np.eye(x.size) + gram[:, 1:, 1:]), np.float64)
    slope = gram[:, 1:, 0] - x - kink
    step = np.einsum("cij,cj->ci", covariance, slope)
    log_z = peak - 0.5 * gram[:, 0, 0] - 0.5 * x @ x + 0.5 * np.sum(step * slope, axis=1)
    volume, kept = laplace(x + step, covariance, one_sided)
    log_z += volume + kept
    weight = np.exp(log_z - logsumexp(log_z))
    mean = x + weight @ step
    return LaplacePosterior(
        float(logsumexp(log_z) - np.log(log_z.size)), mean, np.tensordot(weight, covariance, 1)
    )


def laplace(mode: Floats, covariance: Floats, one_sided: np.ndarray) -> tuple[Floats, Floats]:
    r"""Logarithms (...,) of the posterior's volume, and of the part of it within the bounds over that of the prior.

    .. math:: \tfrac12 \ln |C|, \qquad \ln 2^k P(a \ge 0)

    at modes m (..., d) without bounds, with covariances C (..., d, d), the prior being N(0, I), half-normal where
    ``one_sided`` (d,). Added to ln p(y, m) without the prior's normalisation they give ln Z.
    """
    bounded = np.flatnonzero(one_sided)
    share = log_share(mode[..., bounded], covariance[..., bounded[:, None], bounded])
    return 0.5 * np.linalg.slogdet(covariance)[1], share + bounded.size * np.log(2.0)


def _level_combinations(whitening: Whitening, residual: Floats, jacobian: Floats) -> tuple[Floats, Floats]:
    """Gram matrices (c, d + 1, d + 1) and densities at zero (c,) of every combination of the blocks' levels."""
    pairs = zip(whitening.grams(residual, jacobian), whitening.peaks, strict=True)
    return reduce(_add_block, pairs)


def _add_block(some: tuple[Floats, Floats], more: tuple[Floats, Floats]) -> tuple[Floats, Floats]:
    size = some[0].shape[-1]
    gram = (some[0][:, None] + more[0][None]).reshape(-1, size, size)
    return gram, (some[1][:, None] + more[1][None]).ravel()


INTERVAL_WIDENING = 1.2
"""Factor on the standard deviation of an amplitude for the errors of the model beyond its noise: of 21 effects
that were
named correctly, late activation aside, the errors are 1.12 times as large as expected, and three exceed two standard
deviations."""
LARGEST_INFORMED_VARIANCE = 0.9
"""The largest posterior variance of a coordinate that counts as informed by the data."""


@dataclass(frozen=True, eq=False)
class Explanation:
    """A fit and its posterior."""

    fit: Fit
    posterior: LaplacePosterior

    @classmethod
    def from_fit(cls, fit: Fit, values: Floats, whitening: Whitening) -> "Explanation":
        """The posterior of the model linear about the fit; values: the data (n,)."""
        return cls(fit, linear_posterior(fit, values, whitening))

    @property
    def effects(self) -> tuple[str, ...]:
        return self.fit.hypothesis.effects

    @property
    def log_evidence(self) -> float:
        return self.posterior.log_evidence

    def log_evidence_at_scale(self, name: str, factor: float) -> float:
        r"""ln Z if the prior of a coordinate had the standard deviation f = ``factor`` instead of 1, without a new fit.

        .. math:: \ln \frac{Z_f}{Z_1} = \frac{m^2 (v_f - v)}{2 v^2} + \frac12 \ln \frac{v_f}{f^2 v}
                  + \ln \frac{\Phi(m \sqrt{v_f} / v)}{\Phi(m / \sqrt v)}, \qquad
                  \frac1{v_f} = \frac1v - 1 + \frac1{f^2},

        with the mean m and the variance v of its posterior, the last term if it is one-sided; exact where the model is
        linear.
        """
        index = self.fit.hypothesis.names.index(name)
        mean, variance = self.posterior.mean[index], self.posterior.covariance[index, index]
        changed = 1.0 / (1.0 / variance - 1.0 + 1.0 / factor**2)
        gain = 0.5 * (mean / variance) ** 2 * (changed - variance) + 0.5 * np.log(
            changed / factor**2 / variance
        )
        if self.fit.hypothesis.coordinates[index].one_sided:
            gain += log_ndtr(mean / variance * np.sqrt(changed)) - log_ndtr(mean / np.sqrt(variance))
        return float(self.log_evidence + gain)

    def interval(self, name: str, level: float = 0.95) -> tuple[float, float, float]:
        """Median, least and largest value of a coordinate from the data alone; a one-sided one is cut off at 0.

        A reported amplitude was selected for its size: the prior, which draws it back to 0, is divided out of the
        posterior N(m, v), which leaves N(m / (1 - v), v / (1 - v)), its standard deviation widened by
        ``INTERVAL_WIDENING``.
        """
        index = self.fit.hypothesis.names.index(name)
        variance = min(self.posterior.covariance[index, index], LARGEST_INFORMED_VARIANCE)
        mean = self.posterior.mean[index] / (1.0 - variance)
        sd = INTERVAL_WIDENING * np.sqrt(variance / (1.0 - variance))
        below = ndtr(-mean / sd) if self.fit.hypothesis.coordinates[index].one_sided else 0.0
        ranks = below + (1.0 - below) * np.array([0.5, 0.5 - 0.5 * level, 0.5 + 0.5 * level])
        middle, low, high = (mean + sd * ndtri(ranks)).tolist()
        return middle, low, high


def linear_posterior(fit: Fit, values: Floats, whitening: Whitening) -> LaplacePosterior:
    """The posterior of the model that is linear about the fit, under this noise."""
    kink = fit.kink if fit.settled else 0.0
    return posterior(whitening, fit.x, values - fit.predicted, fit.jacobian, fit.hypothesis.one_sided, kink)

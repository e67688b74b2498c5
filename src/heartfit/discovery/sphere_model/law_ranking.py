r"""The law that the function of a place follows.

The fit of a place has a Gaussian posterior N(m, C) of the coefficients z, under their prior N(0, I). Divided by the
prior it is their likelihood. A law gives them as :math:`z = \theta z_1(s)` with a size theta, of the prior
:math:`N(0, 1)` in units of its scale, half-normal where no size is negative, and a shape s, so that

.. math:: L(\theta, s) \propto e^{b \theta - \frac12 (a - 1) \theta^2}, \quad a = z_1^T (C^{-1} - I) z_1 + 1, \quad
          b = z_1^T C^{-1} m, \qquad \int L\, p(\theta)\, d\theta = a^{-1/2} e^{b^2 / 2a} \,[2 \Phi(b / \sqrt a)] ,

averaged over the shapes. It costs no simulation. Differences between laws have a meaning, their values have none.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy.special import log_ndtr, logsumexp

from heartfit.core.arrays import Floats
from heartfit.places.laws import Law
from heartfit.places.periodic import PeriodicFunction
from heartfit.places.place import FunctionOfTime

SCALES = (0.3, 1.0, 3.0)
"""Standard deviations of a size over the scale of its law, equally likely."""


@dataclass(frozen=True, eq=False)
class FittedLaw:
    """A law with its marginal ln likelihood, up to a constant of all laws, its most probable shape and size [SI]."""

    law: Law
    ln_likelihood: float
    shape: int
    size: float

    @property
    def values(self) -> Floats:
        """Its function (k,)."""
        return self.size * self.law.curves[self.shape]


@dataclass(frozen=True, eq=False)
class FunctionPosterior:
    """Posterior N(mean (d,), covariance (d, d)) of the coefficients of a function of time, of a period [s]."""

    kind: type[FunctionOfTime]
    mean: Floats
    covariance: Floats
    period: float

    def values(self, times: Floats) -> tuple[Floats, Floats]:
        """Return mean and standard deviation (k,) of the function at ``times`` (k,) [s]."""
        basis = self.kind.basis(times, self.period)
        sd = np.sqrt(np.einsum("ki,ij,kj->k", basis, self.covariance, basis))
        return basis @ self.mean, sd

    def rank(self, laws: Iterable[Law]) -> tuple[FittedLaw, ...]:
        """Return the laws by descending likelihood."""
        return tuple(sorted(map(self._fitted, laws), key=lambda one: -one.ln_likelihood))

    def _fitted(self, law: Law) -> FittedLaw:
        precision = np.linalg.inv(self.covariance)
        units = [law.scale * curve for curve in law.curves]
        z = np.array([self.kind(PeriodicFunction.from_samples(u, self.period)).standardised() for u in units])
        informed = np.einsum("si,ij,sj->s", z, precision - np.eye(z.shape[1]), z)
        b = z @ precision @ self.mean
        likelihoods = np.array([_marginal(np.maximum(informed, 0.0), b, sd, law.one_sided) for sd in SCALES])
        flat = int(np.argmax(likelihoods))
        shape, sd = flat % len(units), SCALES[flat // len(units)]
        size = b[shape] / (max(informed[shape], 0.0) + sd**-2)
        size = max(size, 0.0) if law.one_sided else size
        marginal = float(logsumexp(likelihoods) - np.log(likelihoods.size))
        return FittedLaw(law, marginal, shape, float(size * law.scale))


def _marginal(informed: Floats, b: Floats, sd: float, one_sided: bool) -> Floats:
    """ln of the integral of the likelihood over sizes of the standard deviation ``sd``, for every shape."""
    a = informed * sd**2 + 1.0
    scaled = sd * b
    total: Floats = 0.5 * scaled**2 / a - 0.5 * np.log(a)
    return total + (log_ndtr(scaled / np.sqrt(a)) + np.log(2.0) if one_sided else 0.0)

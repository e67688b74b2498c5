r"""The fit context: data, whitenings, and the Gaussian-process (GP) discrepancy.

The discrepancy of a model is a smooth function delta of the phase: a Gaussian process with the covariance
:math:`g^2 K` of :mod:`heartfit.discovery.inference.data`, g one of three sizes, equally likely. The evidence is that of
the fit with :math:`\Sigma + g^2 K` in place of Sigma, the model linear about the fit: it costs no simulation. Next to
the baseline it stands for "something, but none of the library"; on top of the best effect it tests what that leaves.

The curve itself, given the data, is

.. math:: E[\delta \mid y] = g^2 K C^{-1} (y - f + J x), \quad C = \Sigma + g^2 K + J J^T,
          \quad \mathrm{Cov}[\delta \mid y] = g^2 K - g^4 K C^{-1} K ,

at the most probable size and levels of the noise.

References: Kennedy and O'Hagan 2001, doi:10.1111/1467-9868.00294; Berger and Guglielmi 2001,
doi:10.1198/016214501750333045.
"""

from dataclasses import dataclass, field

import numpy as np
from scipy.linalg import block_diag, cho_factor, cho_solve
from scipy.special import logsumexp

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.data import Block, Data, Whitening
from heartfit.discovery.inference.evidence import (
    SIMULATION_LIMIT,
    Explanation,
    Fit,
    fit,
    linear_posterior,
)
from heartfit.discovery.inference.hypothesis import CountedHypothesis, Hypothesis

DISCREPANCY_SIZES = (0.4, 1.0, 2.5)
"""g: from a discrepancy that hides in the noise of one curve to an obvious one."""


@dataclass(frozen=True, eq=False)
class Discrepancy:
    """Estimated discrepancy of one curve: mean (k,) and standard deviation (k,) in its unit at the block's times."""

    block: Block
    mean: Floats
    sd: Floats


@dataclass(frozen=True, eq=False)
class GPDiscrepancy:
    """The data's whitenings under each size of the discrepancy."""

    data: Data
    whitenings: tuple[Whitening, ...]

    @classmethod
    def from_data(cls, data: Data) -> "GPDiscrepancy":
        """Whitenings for all of ``DISCREPANCY_SIZES``."""
        return cls(data, tuple(Whitening.from_data(data, size) for size in DISCREPANCY_SIZES))

    def log_evidence(self, fit: Fit) -> float:
        """ln Z of the discrepancy added to the fitted hypothesis."""
        return float(logsumexp(self._by_size(fit)) - np.log(len(DISCREPANCY_SIZES)))

    def curves(self, fit: Fit) -> tuple[Discrepancy, ...]:
        """Estimated discrepancy of the fitted hypothesis, block after block."""
        best = int(np.argmax(self._by_size(fit)))
        at_centre = self.data.values - fit.predicted + fit.jacobian @ fit.x
        levels, scale = self.whitenings[best].most_probable_levels(self.data.values - fit.predicted)
        return _conditional_curves(self.data, at_centre, fit.jacobian, DISCREPANCY_SIZES[best], levels, scale)

    def _by_size(self, fit: Fit) -> list[float]:
        values = self.data.values
        return [linear_posterior(fit, values, whitening).log_evidence for whitening in self.whitenings]


def _conditional_curves(
    data: Data, at_centre: Floats, jacobian: Floats, size: float, levels: list[int], scale: float
) -> tuple[Discrepancy, ...]:
    """Mean and standard deviation of delta given ``at_centre`` (n,), the residual at the centre of the priors."""
    smooth = [
        size**2 * block.noise.discrepancy_covariance(block.times, block.times, block.period)
        for block in data.blocks
    ]
    K = block_diag(*smooth)
    structure = 0.0 if data.structure is None else scale**2 * data.structure
    factor = cho_factor(data.noise_covariance(levels) + structure + K + jacobian @ jacobian.T)
    mean = K @ cho_solve(factor, at_centre)
    variance = np.diag(K) - np.einsum("ij,ji->i", K, cho_solve(factor, K))
    sd = np.sqrt(np.maximum(variance, 0.0))
    return tuple(
        Discrepancy(block, mean[rows], sd[rows]) for block, rows in zip(data.blocks, data.rows, strict=True)
    )


@dataclass(eq=False)
class FitContext:
    """Fits hypotheses to the same data and counts all simulations."""

    data: Data
    simulations: int = 0
    whitening: Whitening = field(init=False)
    discrepancy: GPDiscrepancy = field(init=False)

    def __post_init__(self) -> None:
        self.whitening, self.discrepancy = Whitening.from_data(self.data), GPDiscrepancy.from_data(self.data)

    def explain(
        self,
        hypothesis: Hypothesis,
        start: Floats,
        slopes: Floats | None = None,
        trusted: int = 0,
        target: float = np.inf,
        limit: int = SIMULATION_LIMIT,
    ) -> Explanation | None:
        """Fit the hypothesis as :func:`fit` does; None where its simulations fail."""
        model = CountedHypothesis(hypothesis)
        fitted = fit(model, self.data.values, self.whitening, start, slopes, trusted, target, limit)
        self.simulations += model.runs
        return None if fitted is None else Explanation.from_fit(fitted, self.data.values, self.whitening)

    def simulate(self, hypothesis: Hypothesis, x: Floats) -> Floats | None:
        """Prediction (n,) of the hypothesis at x (d,); None where the simulation fails."""
        self.simulations += 1
        return hypothesis.forward(x)

    def linearise(self, hypothesis: Hypothesis, x: Floats) -> Explanation | None:
        """The hypothesis at x (d,), not fitted, with its slopes there; None where the simulation fails."""
        model = CountedHypothesis(hypothesis)
        predicted = model(x)
        if predicted is None:
            return None
        jacobian = model.jacobian(x, predicted)
        self.simulations += model.runs
        unfitted = Fit(hypothesis, x, predicted, jacobian, np.inf, converged=False)
        return Explanation.from_fit(unfitted, self.data.values, self.whitening)

    def improve(
        self,
        old: Explanation,
        start: Floats,
        slopes: Floats | None = None,
        trusted: int = 0,
        patience: float = np.inf,
    ) -> Explanation:
        """Refit the hypothesis from ``start`` (d,); the old explanation where the objective is not lower there.

        patience: how far above the old objective the prediction of fresh slopes may end before the fit is given up.
        """
        target = old.fit.objective + patience
        new = self.explain(old.fit.hypothesis, start, slopes, trusted, target)
        return new if new is not None and new.fit.objective < old.fit.objective else old

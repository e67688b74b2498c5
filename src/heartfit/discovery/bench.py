"""The data with their whitenings, where hypotheses are fitted and judged."""

from dataclasses import dataclass, field

import numpy as np

from heartfit.discovery.data import Data
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.forward import Counted
from heartfit.discovery.hypothesis import Hypothesis
from heartfit.discovery.optimise import Fit, fit
from heartfit.discovery.rival import Rival
from heartfit.discovery.whitening import Whitening
from heartfit.geometry.arrays import Floats


@dataclass(eq=False)
class Bench:
    """Fits hypotheses to the same data and counts the simulations of all."""

    data: Data
    simulations: int = 0
    whitening: Whitening = field(init=False)
    rival: Rival = field(init=False)

    def __post_init__(self) -> None:
        self.whitening, self.rival = Whitening.of(self.data), Rival.of(self.data)

    def explain(
        self,
        hypothesis: Hypothesis,
        start: Floats,
        slopes: Floats | None = None,
        trusted: int = 0,
        target: float = np.inf,
    ) -> Explanation | None:
        """The hypothesis as :func:`heartfit.discovery.optimise.fit` finds it, or None where its simulations fail."""
        model = Counted(hypothesis)
        found = fit(model, self.data.values, self.whitening, start, slopes, trusted, target)
        self.simulations += model.runs
        return None if found is None else Explanation.of(found, self.data.values, self.whitening)

    def simulate(self, hypothesis: Hypothesis, x: Floats) -> Floats | None:
        """What the hypothesis predicts (n,) at x (d,), or None."""
        self.simulations += 1
        return hypothesis.forward(x)

    def linear(self, hypothesis: Hypothesis, x: Floats) -> Explanation | None:
        """The hypothesis at x (d,) as it is, with its slopes; None where the simulation fails."""
        model = Counted(hypothesis)
        predicted = model(x)
        if predicted is None:
            return None
        jacobian = model.jacobian(x, predicted)
        self.simulations += model.runs
        there = Fit(hypothesis, x, predicted, jacobian, np.inf, converged=False)
        return Explanation.of(there, self.data.values, self.whitening)

    def better(
        self,
        old: Explanation,
        start: Floats,
        slopes: Floats | None = None,
        trusted: int = 0,
        patience: float = np.inf,
    ) -> Explanation:
        """The old explanation, or one of a lower objective if the fit finds it from ``start``.

        patience: above the old objective, what fresh slopes must promise at least.
        """
        target = old.fit.objective + patience
        new = self.explain(old.fit.hypothesis, start, slopes, trusted, target)
        return new if new is not None and new.fit.objective < old.fit.objective else old

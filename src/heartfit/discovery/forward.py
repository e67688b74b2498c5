"""A forward model that counts its runs and knows its slopes."""

import numpy as np

from heartfit.discovery.hypothesis import Hypothesis
from heartfit.geometry.arrays import Floats

DIFFERENCE = 0.02
"""Step of a finite difference, prior standard deviations: beats are smooth on it, the objective to 0.001. With steps of
0.05 to 0.5 their curvature showed as a slope, and fits ended as much as 30 in ln Z above where these end."""
SHORTER = (1.0, 0.5, 0.25, 0.0)
"""Shares of the way from the centre of the priors at which a start is tried, should its simulation fail."""


class Counted:
    """The forward model of a hypothesis, and how many simulations it took."""

    def __init__(self, hypothesis: Hypothesis) -> None:
        self.hypothesis, self.runs = hypothesis, 0

    def __call__(self, x: Floats) -> Floats | None:
        self.runs += 1
        return self.hypothesis.forward(x)

    def started(self, start: Floats) -> tuple[Floats, Floats] | None:
        """The start (d,), or the nearest shorter one whose simulation is completed, and what it predicts (n,)."""
        for share in SHORTER:
            predicted = self(share * start)
            if predicted is not None:
                return share * start, predicted
        return None

    def jacobian(self, x: Floats, predicted: Floats, first: int = 0) -> Floats:
        """Columns ``first`` and on of (n, d); one in whose two directions the simulation fails is zero."""
        return np.column_stack([self._column(x, predicted, index) for index in range(first, x.size)])

    def _column(self, x: Floats, predicted: Floats, index: int) -> Floats:
        for difference in (DIFFERENCE, -DIFFERENCE):
            moved = x.copy()
            moved[index] += difference
            seen = self(moved) if (moved >= self.hypothesis.lower).all() else None
            if seen is not None:
                return (seen - predicted) / difference
        return np.zeros_like(predicted)

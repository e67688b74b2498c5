"""A forward model that counts its runs and knows its slopes."""

import numpy as np

from heartfit.discovery.hypothesis import Hypothesis
from heartfit.geometry.arrays import Floats

DIFFERENCE = 0.1
"""Step of a finite difference, prior standard deviations, while nothing is known of the slopes."""
LEAST, MOST = 0.05, 0.5
"""Of a step once the slopes are known: it changes the data by about their noise, so that neither the simulation's
roughness nor its curvature shows in the difference."""
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

    def jacobian(
        self, x: Floats, predicted: Floats, first: int = 0, responses: Floats | None = None
    ) -> Floats:
        """Columns ``first`` and on of (n, d); one in whose two directions the simulation fails is zero.

        responses (d,): by how many standard deviations of the noise a coordinate changes the data, as far as known.
        """
        steps = np.full(x.size, DIFFERENCE) if responses is None else differences(responses)
        return np.column_stack(
            [self._column(x, predicted, index, steps[index]) for index in range(first, x.size)]
        )

    def _column(self, x: Floats, predicted: Floats, index: int, step: float) -> Floats:
        for difference in (step, -step):
            moved = x.copy()
            moved[index] += difference
            seen = self(moved) if (moved >= self.hypothesis.lower).all() else None
            if seen is not None:
                return (seen - predicted) / difference
        return np.zeros_like(predicted)


def differences(responses: Floats) -> Floats:
    """Steps (d,) that change the data by about one standard deviation."""
    return np.clip(1.0 / np.maximum(responses, 1.0 / MOST), LEAST, MOST)

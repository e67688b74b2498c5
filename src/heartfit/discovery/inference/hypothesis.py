"""Hypotheses of missing effects and their forward models."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from heartfit.core.arrays import Floats

Forward = Callable[[Floats], Floats | None]
"""Map from coordinates (d,) to predicted data (n,); None where the simulation fails."""


@dataclass(frozen=True)
class Coordinate:
    """A standardised unknown: prior N(0, 1), half-normal (x >= 0) where ``one_sided``.

    amplitude: the coordinate switches an effect on; 0 is the model without it, 1 its typical size.
    """

    name: str
    one_sided: bool = False
    amplitude: bool = False


def _forward_itself(x: Floats) -> None:
    """No other forward model near x (d,)."""


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """A model with the named effects, all its coordinates free.

    The base coordinates come first and are the same in all hypotheses; each effect adds one amplitude, in the order of
    ``effects``, and its other unknowns. With all amplitudes 0 the forward model is the baseline's.

    near: the forward model for points near x (d,), from whose differences slopes follow; None for ``forward`` itself.
    """

    effects: tuple[str, ...]
    coordinates: tuple[Coordinate, ...]
    forward: Forward
    near: Callable[[Floats], Forward | None] = _forward_itself

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the coordinates."""
        return tuple(coordinate.name for coordinate in self.coordinates)

    @cached_property
    def one_sided(self) -> np.ndarray:
        """Mask (d,) of the coordinates that cannot be negative."""
        return np.array([coordinate.one_sided for coordinate in self.coordinates], dtype=bool)

    @cached_property
    def lower(self) -> Floats:
        """Least value of each coordinate (d,)."""
        return np.where(self.one_sided, 0.0, -np.inf)

    @cached_property
    def amplitudes(self) -> np.ndarray:
        """Mask (d,) of the amplitudes."""
        return np.array([coordinate.amplitude for coordinate in self.coordinates], dtype=bool)

    def at(self, amplitude: float) -> Floats:
        """The prior mean (d,), with all amplitudes at one value."""
        return np.where(self.amplitudes, amplitude, 0.0)


DIFFERENCE_STEP = 0.02
"""Step of a finite difference [prior standard deviations]: beats are smooth on it, the objective to 0.001. With
steps of
0.05 to 0.5 curvature counted as slope, and fits ended as much as 30 in ln Z higher."""
START_SHARES = (1.0, 0.5, 0.25, 0.0)
"""Shares of the way from the prior mean at which a start is tried, in this order, until a simulation is completed."""


class CountedHypothesis:
    """The forward model of a hypothesis with a counter of its simulations."""

    def __init__(self, hypothesis: Hypothesis) -> None:
        self.hypothesis, self.runs = hypothesis, 0

    def __call__(self, x: Floats) -> Floats | None:
        return self._run(self.hypothesis.forward, x)

    def simulate_start(self, start: Floats) -> tuple[Floats, Floats] | None:
        """The start (d,), or the first shortened one whose simulation is completed, and its prediction (n,)."""
        for share in START_SHARES:
            predicted = self(share * start)
            if predicted is not None:
                return share * start, predicted
        return None

    def jacobian(self, x: Floats, predicted: Floats, first: int = 0, step: float = DIFFERENCE_STEP) -> Floats:
        """Columns ``first`` and on of (n, d); a column is zero where the simulation fails in both directions.

        The differences are those of the forward model near x, or of the other one where that one fails.
        """
        models = self._models_near(x, predicted)
        return np.column_stack([self._column(models, x, index, step) for index in range(first, x.size)])

    def _models_near(self, x: Floats, predicted: Floats) -> list[tuple[Forward, Floats]]:
        """The forward models that slopes at x (d,) may follow from, the best first, with their predictions (n,)."""
        models = [(self.hypothesis.forward, predicted)]
        near = self.hypothesis.near(x)
        centre = None if near is None else self._run(near, x)
        return models if near is None or centre is None else [(near, centre), *models]

    def _column(self, models: Sequence[tuple[Forward, Floats]], x: Floats, index: int, step: float) -> Floats:
        for forward, centre in models:
            for difference in (step, -step):
                shifted = x.copy()
                shifted[index] += difference
                within = (shifted >= self.hypothesis.lower).all()
                prediction = self._run(forward, shifted) if within else None
                if prediction is not None:
                    return (prediction - centre) / difference
        return np.zeros_like(models[0][1])

    def mean_slopes(self, x: Floats, predicted: Floats, reach: float) -> Floats:
        """Mean slopes (n, d) from ``reach`` below x (d,), or from the bound, to ``reach`` above it.

        A slope is one-sided where a simulation fails, and zero where those to both sides do.
        """
        models = self._models_near(x, predicted)
        return np.column_stack([self._mean_slope(models, x, index, reach) for index in range(x.size)])

    def _mean_slope(
        self, models: Sequence[tuple[Forward, Floats]], x: Floats, index: int, reach: float
    ) -> Floats:
        low, high = max(x[index] - reach, self.hypothesis.lower[index]), x[index] + reach
        for forward, centre in models:
            ends = {x[index]: centre}
            for value in {low, high} - {x[index]}:
                prediction = self._run(forward, np.where(np.arange(x.size) == index, value, x))
                ends |= {} if prediction is None else {value: prediction}
            if len(ends) > 1:
                return (ends[max(ends)] - ends[min(ends)]) / (max(ends) - min(ends))
        return np.zeros_like(models[0][1])

    def _run(self, forward: Forward, x: Floats) -> Floats | None:
        self.runs += 1
        return forward(x)

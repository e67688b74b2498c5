"""What may be missing from a model, as a map from standardised coordinates to curves."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from heartfit.geometry.arrays import Floats

Forward = Callable[[Floats], Floats | None]
"""From coordinates (d,) to predicted data (n,), or None where the simulation fails."""


@dataclass(frozen=True)
class Coordinate:
    """A standardised unknown: prior N(0, 1), half-normal (x >= 0) where ``one_sided``.

    amplitude: the coordinate switches an effect on, 0 is the model without it and 1 its typical size.
    """

    name: str
    one_sided: bool = False
    amplitude: bool = False


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """A model with the named effects, all its coordinates free.

    The base coordinates come first and are the same in all hypotheses; each effect adds one amplitude, in the order of
    ``effects``, and what else is unknown of it. With all amplitudes 0 the forward model is that of no effect.
    """

    effects: tuple[str, ...]
    coordinates: tuple[Coordinate, ...]
    forward: Forward

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the coordinates."""
        return tuple(each.name for each in self.coordinates)

    @cached_property
    def one_sided(self) -> np.ndarray:
        """Which coordinates cannot be negative (d,)."""
        return np.array([each.one_sided for each in self.coordinates], dtype=bool)

    @cached_property
    def lower(self) -> Floats:
        """Least value of each coordinate (d,)."""
        return np.where(self.one_sided, 0.0, -np.inf)

    @cached_property
    def amplitudes(self) -> np.ndarray:
        """Which coordinates are amplitudes (d,)."""
        return np.array([each.amplitude for each in self.coordinates], dtype=bool)

    def at(self, amplitude: float) -> Floats:
        """The centre of the priors (d,), with all amplitudes at one value."""
        return np.where(self.amplitudes, amplitude, 0.0)

"""Beats at a point of an extension and around it, from whose differences its slopes follow."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.refit.extension import Extension
from heartfit.heart.beat import Beat

DIFFERENCE = 0.25
"""Step of beats that are simulated one by one [prior standard deviations]: long enough for the roughness of a limit
cycle."""


@dataclass(frozen=True, eq=False)
class NearbyBeats:
    """The beat at a point (d,), and those ``step`` prior standard deviations further along each coordinate.

    simulations: number of beats that were run.
    """

    centre: Beat
    others: tuple[Beat, ...]
    step: float
    simulations: int


class Simulator(Protocol):
    """The model of a case that is refitted."""

    def __call__(self, extension: Extension, parameters: Mapping[str, float]) -> Beat:
        """The beat of an extended setting with all its parameters, by name [SI]."""

    def nearby(self, extension: Extension, x: Floats) -> NearbyBeats:
        """The beats at the coordinates x (d,) and around them; failed where there are none."""


def points_around(x: Floats, step: float) -> Floats:
    """The point x (d,) and those a step further along each coordinate, (1 + d, d).

    Forwards, so that no amplitude leaves its bound.
    """
    points: Floats = x + step * np.eye(x.size + 1, x.size, k=-1)
    return points


def simulate_each(run: Simulator, extension: Extension, x: Floats) -> NearbyBeats:
    """The beats at and around x (d,), one by one."""
    points = points_around(x, DIFFERENCE)
    centre, *others = (run(extension, extension.parameters(point)) for point in points)
    return NearbyBeats(centre, tuple(others), DIFFERENCE, len(points))

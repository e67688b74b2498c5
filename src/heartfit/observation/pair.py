"""The same beat twice: as it was, and as it was measured."""

from collections.abc import Mapping
from dataclasses import dataclass

from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures
from heartfit.observation.vector import observe


@dataclass(frozen=True, eq=False)
class Reading:
    """What is read off a beat: curves by name ("lv_volume", ...) and observations by name, SI."""

    curves: Mapping[str, Curve]
    observations: Mapping[str, float]

    @classmethod
    def of(cls, curves: Mapping[str, Curve], features: Mapping[str, CurveFeatures]) -> "Reading":
        """The reading of curves by an operator each; raises ValueError for a curve that is not there."""
        return cls(curves, observe(curves, features))


@dataclass(frozen=True, eq=False)
class Pair:
    """The true beat and the one that was measured of it, read by the same operators."""

    true: Reading
    measured: Reading

"""Passages between two compartments, by conductance and orifice."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.places.place import Place
from heartfit.roles import Flow
from heartfit.roles.laws import Branch


@dataclass(frozen=True)
class Passage(Place, Flow):
    """A conductance [m^3/(s Pa)] beside an orifice of an area [m^2], both for forward flow; amplitude: of the area."""

    conductance: float
    area: float
    unit = "m^2"
    amplitude = 0.2e-4
    size = 2
    one_sided = True
    CONDUCTANCE = 1e-8

    @classmethod
    def from_standardised(cls, z: Floats, period: float) -> Self:  # noqa: ARG003
        if np.any(z < 0.0):
            raise ValueError(f"passage: coefficients {z}; expected none that is negative")
        return cls(cls.CONDUCTANCE * float(z[0]), cls.amplitude * float(z[1]))

    def sizes(self) -> Mapping[str, float]:
        return {"conductance": self.conductance, "orifice": self.area}

    def law(self, time: Floats) -> Branch:  # noqa: ARG002
        return Branch(conductance=self.conductance, area=self.area)

"""Forms of places in the blood: a pressure, a flow, a passage between two compartments, a loss in a valve."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.places.place import FunctionOfTime, Place
from heartfit.roles import Flow, Narrowing, Pressure
from heartfit.roles.laws import Branch


@dataclass(frozen=True)
class AddedPressure(FunctionOfTime, Pressure):
    """A free function of time [Pa] that is added to the pressure of its compartments."""

    unit = "Pa"

    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:  # noqa: ARG002
        return self.function.at(time)


@dataclass(frozen=True)
class AddedFlow(FunctionOfTime, Flow):
    """A free function of time [m^3/s]: a flow between two compartments that no pressure drives."""

    unit = "m^3/s"
    amplitude = 60e-6

    def law(self, time: Floats) -> Branch:
        return Branch(source=self.function.at(time))


@dataclass(frozen=True)
class Passage(Place, Flow):
    """Conductance [m^3/(s Pa)] in parallel with an orifice [m^2], both for forward flow; amplitude: the area."""

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


@dataclass(frozen=True)
class ValveLoss(Place, Narrowing):
    r"""Loss :math:`\tfrac12 \rho a q^2` of pressure in series with a valve of the flow q, a >= 0 [1/m^4]."""

    loss: float
    unit = "1/m^4"
    amplitude = 1e8
    size = 1
    one_sided = True

    @classmethod
    def from_standardised(cls, z: Floats, period: float) -> Self:  # noqa: ARG003
        if np.any(z < 0.0):
            raise ValueError(f"valve loss: coefficient {z}; expected none that is negative")
        return cls(cls.amplitude * float(z[0]))

    def sizes(self) -> Mapping[str, float]:
        return {"loss": self.loss}

    def inverse_square(self) -> float:
        return self.loss

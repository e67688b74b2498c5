"""A pressure in the left atrium."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.places.periodic import Place
from heartfit.roles import Pressure


@dataclass(frozen=True)
class AtrialPressure(Place, Pressure):
    """Pressure [Pa] added to that of the left atrium, or lost in the mitral valve: volumes do not tell them apart."""

    compartments = ("left_atrium",)
    amplitude = 1000.0

    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:  # noqa: ARG002
        return self.function.at(time, period)

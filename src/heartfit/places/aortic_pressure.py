"""A pressure in the aorta."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.places.periodic import Place
from heartfit.roles import Pressure


@dataclass(frozen=True)
class AorticPressure(Place, Pressure):
    """Pressure [Pa] added to that of the Windkessel, as by waves, or lost in the aortic valve."""

    compartments = ("aorta",)
    amplitude = 3000.0

    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:  # noqa: ARG002
        return self.function.at(time, period)

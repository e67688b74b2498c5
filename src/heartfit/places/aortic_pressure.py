"""A pressure in the aorta."""

from dataclasses import dataclass

from heartfit.places.place import AddedPressure


@dataclass(frozen=True)
class AorticPressure(AddedPressure):
    """Pressure [Pa] added to that of the Windkessel, as by waves, or lost in the aortic valve."""

    region = "ejection"
    slot = "the pressure of the aorta, or a loss in the aortic valve"
    compartments = ("aorta",)
    amplitude = 3000.0

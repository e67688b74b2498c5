"""A pressure in the left atrium."""

from dataclasses import dataclass

from heartfit.places.place import AddedPressure


@dataclass(frozen=True)
class AtrialPressure(AddedPressure):
    """Pressure [Pa] added to that of the left atrium, or lost in the mitral valve: volumes do not tell them apart."""

    region = "filling"
    slot = "the pressure of the left atrium, less a loss in the mitral valve"
    compartments = ("left_atrium",)
    amplitude = 1000.0

"""A pressure in the left atrium."""

from dataclasses import dataclass

from heartfit.places.periodic import AddedPressure


@dataclass(frozen=True)
class AtrialPressure(AddedPressure):
    """Pressure [Pa] added to that of the left atrium, or lost in the mitral valve: volumes do not tell them apart."""

    compartments = ("left_atrium",)
    amplitude = 1000.0

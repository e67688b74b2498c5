"""An error of the measured volume, free in its value."""

from dataclasses import dataclass

from heartfit.places.sensor import ErrorInValue


@dataclass(frozen=True)
class VolumeScale(ErrorInValue):
    """Error [m^3] at a value."""

    region = "images"
    slot = "the measured volume, at a value"
    unit = "m^3"
    amplitude = 10e-6
    measures = ("lv_volume",)

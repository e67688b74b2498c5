"""An error of the measured volume, free in time."""

from dataclasses import dataclass

from heartfit.places.sensor import ErrorInTime


@dataclass(frozen=True)
class VolumeError(ErrorInTime):
    """Error [m^3] at a time of the beat."""

    region = "images"
    slot = "the measured volume, at a time"
    unit = "m^3"
    amplitude = 10e-6
    measures = ("lv_volume",)

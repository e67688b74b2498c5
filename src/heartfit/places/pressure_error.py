"""An error of the measured pressure, free in time."""

from dataclasses import dataclass

from heartfit.places.sensor import ErrorInTime


@dataclass(frozen=True)
class PressureError(ErrorInTime):
    """Error [Pa] at a time of the beat."""

    region = "catheter"
    slot = "the measured pressure, at a time"
    unit = "Pa"
    amplitude = 1500.0
    measures = ("lv_pressure",)

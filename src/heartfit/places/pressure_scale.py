"""An error of the measured pressure, free in its value."""

from dataclasses import dataclass

from heartfit.places.sensor import ErrorInValue


@dataclass(frozen=True)
class PressureScale(ErrorInValue):
    """Error [Pa] at a value."""

    region = "catheter"
    slot = "the measured pressure, at a value"
    unit = "Pa"
    amplitude = 1500.0
    measures = ("lv_pressure",)

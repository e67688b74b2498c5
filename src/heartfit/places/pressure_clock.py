"""A delay of the measured pressure, free in time."""

from dataclasses import dataclass

from heartfit.places.sensor import ErrorOfClock


@dataclass(frozen=True)
class PressureClock(ErrorOfClock):
    """Delay [s] at a time of the beat."""

    region = "catheter"
    slot = "the times of the measured pressure"
    measures = ("lv_pressure",)

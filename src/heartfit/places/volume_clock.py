"""A delay of the measured volume, free in time."""

from dataclasses import dataclass

from heartfit.places.sensor import ErrorOfClock


@dataclass(frozen=True)
class VolumeClock(ErrorOfClock):
    """Delay [s] at a time of the beat."""

    region = "images"
    slot = "the times of the measured volume"
    measures = ("lv_volume",)

"""What simulated beats show to the calibration."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import repeat

from heartfit.beat import Beat
from heartfit.mechanism import Sensor
from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures
from heartfit.observation.sensors import as_measured
from heartfit.observation.vector import observe


def beat_curves(beat: Beat, sensors: Sequence[Sensor] = ()) -> dict[str, Curve]:
    """Volumes, pressures and flows ("lv_volume", "aorta_pressure", "mitral_flow", ...) with time zero at the
    trigger, as the sensors show them; none of a failed beat.
    """
    if not beat.completed:
        return {}
    inside = beat.time < beat.time[0] + beat.period * (1 - 1e-9)  # the last sample may repeat the first
    curves = {
        name: Curve(beat.time[inside], values[inside], beat.period).shifted(beat.trigger)
        for name, values in beat.signals().items()
    }
    return as_measured(curves, sensors)


def observe_beats(
    beats: Iterable[Beat],
    features: Mapping[str, CurveFeatures],
    sensors: Iterable[Sequence[Sensor]] | None = None,
) -> list[dict[str, float] | str]:
    """Observations of each beat, the reason of a failed one: as `heartfit.calibration.update.calibrate` takes.

    sensors: those of each beat, for a parameter of a sensor may differ from beat to beat as any other; none if
    None.
    """
    pairs = zip(beats, repeat(()), strict=False) if sensors is None else zip(beats, sensors, strict=True)
    return [
        observe(beat_curves(beat, seen_by), features) if beat.completed else beat.reason
        for beat, seen_by in pairs
    ]

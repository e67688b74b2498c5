"""What simulated beats show to the calibration."""

from collections.abc import Iterable, Mapping

from heartfit.beat import Beat
from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures
from heartfit.observation.vector import observe


def beat_curves(beat: Beat) -> dict[str, Curve]:
    """Volumes, pressures and flows ("lv_volume", "aorta_pressure", "mitral_flow", ...) with time zero at the
    trigger; none of a failed beat.
    """
    if not beat.completed:
        return {}
    inside = beat.time < beat.time[0] + beat.period * (1 - 1e-9)  # the last sample may repeat the first
    return {
        name: Curve(beat.time[inside], values[inside], beat.period).shifted(beat.trigger)
        for name, values in beat.signals().items()
    }


def observe_beats(
    beats: Iterable[Beat], features: Mapping[str, CurveFeatures]
) -> list[dict[str, float] | str]:
    """Observations of each beat, the reason of a failed one: as `heartfit.calibration.update.calibrate` takes."""
    return [observe(beat_curves(beat), features) if beat.completed else beat.reason for beat in beats]

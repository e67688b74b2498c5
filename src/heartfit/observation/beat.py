"""What a beat, simulated or measured, shows to the calibration."""

from collections.abc import Iterable, Mapping
from types import MappingProxyType

from heartfit.beat import Beat
from heartfit.observation.curve import Curve
from heartfit.observation.noise import Observation, measure
from heartfit.observation.operator import CurveFeatures, PressureFeatures, VolumeFeatures

VOLUME, PRESSURE = VolumeFeatures(), PressureFeatures()
LEFT_VOLUME: Mapping[str, CurveFeatures] = MappingProxyType({"lv_volume": VOLUME})


def beat_curves(beat: Beat) -> dict[str, Curve]:
    """Volumes, pressures and flows ("lv_volume", "aorta_pressure", "mitral_flow", ...) with time zero at the
    trigger.

    Raises ValueError for a failed beat, which has no curves worth observing.
    """
    if beat.status != "completed":
        raise ValueError(f"observation: the beat is {beat.status} ({beat.reason}); expected a completed beat")
    inside = beat.time < beat.time[0] + beat.period * (1 - 1e-9)
    groups = {"volume": beat.volume, "pressure": beat.pressure, "flow": beat.flow}
    return {
        f"{name}_{kind}": Curve(beat.time[inside], values[inside], beat.period).shifted(beat.trigger)
        for kind, group in groups.items()
        for name, values in group.items()
    }


def operators(
    curves: Iterable[str],
    volume: CurveFeatures = VOLUME,
    pressure: CurveFeatures = PRESSURE,
) -> dict[str, CurveFeatures]:
    """The operators for what was measured: on the LV's volume, and on its pressure if there is one."""
    wanted = {"lv_volume": volume, "lv_pressure": pressure}
    return {name: wanted[name] for name in wanted if name in set(curves)}


def observe(
    curves: Mapping[str, Curve], features: Mapping[str, CurveFeatures] = LEFT_VOLUME
) -> dict[str, float]:
    """The observation vector Z by name, SI: each operator applied to the curve it is named for."""
    _require(curves, features)
    return {
        key: value for curve, operator in features.items() for key, value in operator(curves[curve]).items()
    }


def observe_measured(
    curves: Mapping[str, Curve],
    features: Mapping[str, CurveFeatures] = LEFT_VOLUME,
    period_uncertainty: float = 0.05,
) -> list[Observation]:
    """Z_obs, each number with the noise `heartfit.observation.noise.measure` finds for it."""
    _require(curves, features)
    return [
        observation
        for curve, operator in features.items()
        for observation in measure(operator, curves[curve], period_uncertainty=period_uncertainty)
    ]


def cavity_indices(curves: Mapping[str, Curve], side: str = "lv") -> dict[str, float]:
    """EDV (at the trigger), ESV, stroke volume in m^3 and ejection fraction of one cavity."""
    volume = curves[f"{side}_volume"]
    end_diastolic, end_systolic = float(volume(0.0)), float(volume.values.min())
    stroke = end_diastolic - end_systolic
    return {"EDV": end_diastolic, "ESV": end_systolic, "SV": stroke, "EF": stroke / end_diastolic}


def _require(curves: Mapping[str, Curve], features: Mapping[str, CurveFeatures]) -> None:
    missing = sorted(set(features) - set(curves))
    if missing:
        raise ValueError(f"observation: no curve {', '.join(missing)}; there are {', '.join(sorted(curves))}")

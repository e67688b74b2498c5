"""The observation vector Z: which operator looks at which curve."""

from collections.abc import Iterable, Mapping

from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures, PressureFeatures, VolumeFeatures


def operators(
    measured: Mapping[str, Curve], frames: int | None = None, window: int = 3, order: int = 2
) -> dict[str, CurveFeatures]:
    """Operators by curve: on the LV's volume, at the measured number of frames if None is given, and on its
    pressure where there is one.
    """
    require_curves(measured, ["lv_volume"])
    count = measured["lv_volume"].times.size if frames is None else frames
    chosen: dict[str, CurveFeatures] = {"lv_volume": VolumeFeatures(count, window, order)}
    if "lv_pressure" in measured:
        chosen["lv_pressure"] = PressureFeatures()
    return chosen


def observe(curves: Mapping[str, Curve], features: Mapping[str, CurveFeatures]) -> dict[str, float]:
    """The observations by name, SI; raises ValueError for a curve that is not there."""
    require_curves(curves, features)
    return {
        key: value for curve, operator in features.items() for key, value in operator(curves[curve]).items()
    }


def cavity_indices(curves: Mapping[str, Curve], side: str = "lv") -> dict[str, float]:
    """EDV (largest volume), ESV (least volume), stroke volume in m^3, and ejection fraction of a cavity."""
    require_curves(curves, [f"{side}_volume"])
    volume = curves[f"{side}_volume"]
    end_diastolic, end_systolic = float(volume.values.max()), float(volume.values.min())
    stroke = end_diastolic - end_systolic
    return {"EDV": end_diastolic, "ESV": end_systolic, "SV": stroke, "EF": stroke / end_diastolic}


def require_curves(curves: Mapping[str, Curve], names: Iterable[str]) -> None:
    """Raises ValueError, saying which curves there are, when one is not."""
    missing = sorted(set(names) - set(curves))
    if missing:
        there = ", ".join(sorted(curves)) or "none: did the beat fail?"
        raise ValueError(f"observation: no curve {', '.join(missing)}; there are {there}")

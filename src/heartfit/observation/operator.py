"""Observation operator h: an extremum and two peak rates of a volume or pressure curve (Fig. 2 of the paper).

A curve of any sampling is resampled at equidistant times from time zero (the ECG trigger), then a periodic
Savitzky-Golay filter gives value and rate,

    y_i = sum_j a_j Y_(i+j),   dy/dt_i = sum_j b_j Y_(i+j) / dt,   |j| <= window // 2.

Data and simulation go through the same frames and window, or their peak rates are not comparable: with 25
frames a raw central difference already clips the peaks of a simulated beat.

Reference: Savitzky and Golay 1964, doi:10.1021/ac60214a047; Marchesseau et al. 2012, section 3.
"""

from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import ClassVar

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.observation.curve import Curve


@cache
def _filter_weights(window: int, order: int) -> Floats:
    """Weights (2, window) a and b of a Savitzky-Golay filter: value and slope of the polynomial of best fit.

    They are those of scipy.signal, whose import takes longer than most jobs that filter a curve.
    """
    reach = window // 2
    places = np.arange(-reach, reach + 1.0) / reach
    value, slope = np.linalg.pinv(places[:, None] ** np.arange(order + 1))[:2]
    return np.stack([value, slope / reach])


@dataclass(frozen=True)
class CurveFeatures(ABC):
    """Extremum of a curve and the two peaks of its rate.

    frames: samples in a beat (those of the measured curve); window: odd number of frames; order: degree of the
    polynomial. Window 3 with order 2 keeps the samples and takes raw central differences.
    """

    frames: int = 25
    window: int = 3
    order: int = 2

    names: ClassVar[tuple[str, str, str]]
    unit: ClassVar[str]

    def __post_init__(self) -> None:
        if self.window % 2 == 0 or not 1 <= self.order < self.window <= self.frames:
            raise ValueError(
                f"observation: frames={self.frames}, window={self.window}, order={self.order}; "
                "expected an odd window with 1 <= order < window <= frames"
            )

    @property
    def rates(self) -> tuple[str, str]:
        """Names of the observations that scale with the reciprocal of the period."""
        return self.names[1:]

    @property
    def units(self) -> tuple[str, str, str]:
        return (self.unit, f"{self.unit}/s", f"{self.unit}/s")

    def smooth(self, curve: Curve) -> Curve:
        """Resampled and filtered curve."""
        return self._filter(curve, derivative=0)

    def rate(self, curve: Curve) -> Curve:
        """Resampled and filtered time derivative of the curve."""
        return self._filter(curve, derivative=1)

    def _filter(self, curve: Curve, derivative: int) -> Curve:
        frames, interval = curve.resampled(self.frames), curve.period / self.frames
        wrapped = np.pad(frames.values, self.window // 2, mode="wrap")
        weights = _filter_weights(self.window, self.order)[derivative] / interval**derivative
        return Curve(frames.times, np.correlate(wrapped, weights, mode="valid"), curve.period)

    @abstractmethod
    def extremum(self, values: np.ndarray) -> float:
        """Observed extremum of the values of the curve."""

    def __call__(self, curve: Curve) -> dict[str, float]:
        """Observations by name [SI] of a curve whose time zero is the trigger."""
        rate = self.rate(curve).values
        numbers = (self.extremum(self.smooth(curve).values), float(rate.max()), float(rate.min()))
        return dict(zip(self.names, numbers, strict=True))


@dataclass(frozen=True)
class VolumeFeatures(CurveFeatures):
    """Operator of a volume: V_min, peak filling rate q_max > 0 and peak ejection rate q_min < 0 of q = dV/dt."""

    names: ClassVar = ("V_min", "q_max", "q_min")
    unit: ClassVar = "m^3"

    def extremum(self, values: np.ndarray) -> float:
        return float(values.min())


@dataclass(frozen=True)
class RightVolumeFeatures(VolumeFeatures):
    """Operator of the volume of the right ventricle: its V_min, q_max and q_min."""

    names: ClassVar = ("V_min_rv", "q_max_rv", "q_min_rv")


@dataclass(frozen=True)
class PressureFeatures(CurveFeatures):
    """Operator of a pressure: P_max, dP/dt_max and dP/dt_min; its frames are finer, as catheters sample faster."""

    frames: int = 200
    window: int = 5

    names: ClassVar = ("P_max", "dPdt_max", "dPdt_min")
    unit: ClassVar = "Pa"

    def extremum(self, values: np.ndarray) -> float:
        return float(values.max())


def operators(
    measured: Mapping[str, Curve],
    frames: int | None = None,
    window: int = 3,
    order: int = 2,
    also: Collection[str] = (),
) -> dict[str, CurveFeatures]:
    """Operators by curve: of the LV volume, with its measured number of frames if None, and of an LV pressure.

    ``also`` are the curves that are observed in addition: "rv_volume", like the LV volume, or none.
    """
    require_curves(measured, ["lv_volume", *also])
    count = measured["lv_volume"].times.size if frames is None else frames
    features: dict[str, CurveFeatures] = {"lv_volume": VolumeFeatures(count, window, order)}
    if "lv_pressure" in measured:
        features["lv_pressure"] = PressureFeatures()
    return features | {name: RightVolumeFeatures(count, window, order) for name in also}


def observe(curves: Mapping[str, Curve], features: Mapping[str, CurveFeatures]) -> dict[str, float]:
    """Observe curves: the observations by name [SI]; raises ValueError for a missing curve."""
    require_curves(curves, features)
    return {
        key: value for curve, operator in features.items() for key, value in operator(curves[curve]).items()
    }


def cavity_indices(curves: Mapping[str, Curve], side: str = "lv") -> dict[str, float]:
    """EDV (largest), ESV (smallest) and stroke volume SV [m^3] and ejection fraction EF [1] of a cavity."""
    require_curves(curves, [f"{side}_volume"])
    volume = curves[f"{side}_volume"]
    end_diastolic, end_systolic = float(volume.values.max()), float(volume.values.min())
    stroke = end_diastolic - end_systolic
    return {"EDV": end_diastolic, "ESV": end_systolic, "SV": stroke, "EF": stroke / end_diastolic}


def require_curves(curves: Mapping[str, Curve], names: Iterable[str]) -> None:
    """Raise ValueError, with the names of the present curves, if a curve is missing."""
    missing = sorted(set(names) - set(curves))
    if missing:
        present = ", ".join(sorted(curves)) or "none: did the beat fail?"
        raise ValueError(f"observation: no curve {', '.join(missing)}; there are {present}")


@dataclass(frozen=True, eq=False)
class Reading:
    """Curves of a beat by name ("lv_volume", ...) and its observations by name [SI]."""

    curves: Mapping[str, Curve]
    observations: Mapping[str, float]

    @classmethod
    def from_curves(cls, curves: Mapping[str, Curve], features: Mapping[str, CurveFeatures]) -> "Reading":
        """Observe curves, each by its operator; raises ValueError for a missing curve."""
        return cls(curves, observe(curves, features))


@dataclass(frozen=True, eq=False)
class Pair:
    """True beat and its measurement, observed by the same operators."""

    true: Reading
    measured: Reading

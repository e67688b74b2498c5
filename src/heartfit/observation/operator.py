"""The observation operator h: the three numbers of a volume or pressure curve, as the paper's Fig. 2 takes
them.

A curve of any sampling is resampled at equidistant times from time zero (the ECG trigger), then a periodic
Savitzky-Golay filter gives value and rate,

    y_i = sum_j a_j Y_(i+j),   dy/dt_i = sum_j b_j Y_(i+j) / dt,   |j| <= window // 2.

Data and simulation go through the same frames and window, or their peak rates are not comparable: with 25
frames a raw central difference already clips the peaks of a simulated beat.

Reference: Savitzky and Golay 1964, doi:10.1021/ac60214a047; Marchesseau et al. 2012, section 3.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from heartfit.observation.curve import Curve


@dataclass(frozen=True)
class CurveFeatures(ABC):
    """An extremum of the curve and the two peaks of its rate.

    frames: samples in a beat (those of the measured curve); window: odd number of frames; order of the
    polynomial. window 3 with order 2 keeps the samples and takes raw central differences.
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
        """Names of the observations that go with one over the period."""
        return self.names[1:]

    @property
    def units(self) -> tuple[str, str, str]:
        return (self.unit, f"{self.unit}/s", f"{self.unit}/s")

    def smooth(self, curve: Curve) -> Curve:
        """The curve as the operator sees it."""
        return self._filter(curve, derivative=0)

    def rate(self, curve: Curve) -> Curve:
        """Its time derivative."""
        return self._filter(curve, derivative=1)

    def _filter(self, curve: Curve, derivative: int) -> Curve:
        from scipy.signal import savgol_filter  # 0.4 s to import, and only an observation needs it

        frames = curve.resampled(self.frames)
        values = savgol_filter(
            frames.values,
            self.window,
            self.order,
            deriv=derivative,
            delta=curve.period / self.frames,
            mode="wrap",
        )
        return Curve(frames.times, values, curve.period)

    @abstractmethod
    def extremum(self, values: np.ndarray) -> float:
        """The extremum of the curve itself that is observed."""

    def __call__(self, curve: Curve) -> dict[str, float]:
        """Observations by name, SI, from a curve whose time zero is the trigger."""
        rate = self.rate(curve).values
        numbers = (self.extremum(self.smooth(curve).values), float(rate.max()), float(rate.min()))
        return dict(zip(self.names, numbers, strict=True))


@dataclass(frozen=True)
class VolumeFeatures(CurveFeatures):
    """V_min, peak filling rate q_max > 0 and peak ejection rate q_min < 0 of q = dV/dt."""

    names: ClassVar = ("V_min", "q_max", "q_min")
    unit: ClassVar = "m^3"

    def extremum(self, values: np.ndarray) -> float:
        return float(values.min())


@dataclass(frozen=True)
class PressureFeatures(CurveFeatures):
    """P_max, dP/dt_max and dP/dt_min; a catheter samples faster than an image: frames of 4 ms."""

    frames: int = 200
    window: int = 5

    names: ClassVar = ("P_max", "dPdt_max", "dPdt_min")
    unit: ClassVar = "Pa"

    def extremum(self, values: np.ndarray) -> float:
        return float(values.max())

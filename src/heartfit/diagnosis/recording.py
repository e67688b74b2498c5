"""What was recorded of a heart: curves sampled at their own times, over one beat or several."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.observation.curve import require_pressures, require_volumes

KNOWN = ("lv_volume", "lv_pressure", "aorta_pressure", "rv_volume")
"""Curves that a recording may hold."""
UNSEARCHED = {"rv_volume": "the sphere of the search has no right ventricle"}
"""Those that are kept and not searched, and why."""

FEWEST, SHORTEST = 8, 0.7
"""Samples that a curve must have, and part of the period that they must span: less leaves a phase unseen."""

STILL = 0.05
"""Of its largest value, what a curve that beats exceeds at least from trough to peak."""

PERIODS = (0.25, 2.5)
"""Of a human heart, s."""


@dataclass(frozen=True, eq=False)
class Samples:
    """Values (k,), SI, at increasing times (k,), s after a trigger; times beyond the period are of later beats.

    Raises InputError for other shapes, times that do not increase and numbers that are not finite.
    """

    times: Floats
    values: Floats

    def __post_init__(self) -> None:
        if self.times.ndim != 1 or self.times.shape != self.values.shape:
            raise InputError(
                f"{self.times.shape} times and {self.values.shape} values; expected one value a time"
            )
        if not (np.isfinite(self.times).all() and np.isfinite(self.values).all()):
            raise InputError("a time or a value is not finite: leave the sample out")
        back = np.flatnonzero(np.diff(self.times) <= 0.0)
        if back.size:
            before, after = self.times[back[0]], self.times[back[0] + 1]
            raise InputError(
                f"time goes from {before:g} s to {after:g} s; expected increasing times: sort them"
            )

    def part(self, kept: np.ndarray) -> "Samples":
        """The samples that the mask (k,) keeps."""
        return Samples(self.times[kept], self.values[kept])


@dataclass(frozen=True, eq=False)
class Recording:
    """Curves by name, as in ``KNOWN``, of a heart that beats with the ``period``, s.

    Raises InputError for a missing LV volume, an unknown curve, one too short, and what no human heart can have.
    """

    period: float
    curves: Mapping[str, Samples]

    def __post_init__(self) -> None:
        if not PERIODS[0] < self.period < PERIODS[1]:
            raise InputError(
                f"period = {self.period:g} s; expected {PERIODS[0]:g} to {PERIODS[1]:g} s: state that of one beat"
            )
        if "lv_volume" not in self.curves:
            raise InputError(f"no lv_volume among {', '.join(self.curves) or 'no curves'}: record it")
        for name, samples in self.curves.items():
            self._check(name, samples)

    def _check(self, name: str, samples: Samples) -> None:
        if name not in KNOWN:
            raise InputError(f"{name} is not searched; known are {', '.join(KNOWN)}: leave it out")
        span = float(np.ptp(samples.times)) if samples.times.size else 0.0
        if samples.times.size < FEWEST or span < SHORTEST * self.period:
            raise InputError(
                f"{name}: {samples.times.size} samples over {span:g} s; expected at least {FEWEST} over "
                f"{SHORTEST * self.period:.2g} s: record a whole beat of {self.period:g} s"
            )
        if samples.times.size * self.period < FEWEST * span:
            raise InputError(
                f"{name}: {samples.times.size} samples over {span:g} s, {span / self.period:.0f} beats; expected at "
                f"least {FEWEST} a beat: are the times milliseconds, or the period that of many beats?"
            )
        self._check_values(name, samples)

    def _check_values(self, name: str, samples: Samples) -> None:
        (require_volumes if name.endswith("_volume") else require_pressures)(samples.values)
        if np.ptp(samples.values) < STILL * np.abs(samples.values).max():
            raise InputError(
                f"{name}: values from {samples.values.min():g} to {samples.values.max():g}, SI; expected a curve that "
                "beats: check the column"
            )

    @property
    def searched(self) -> tuple[str, ...]:
        """The curves that a left ventricle alone explains."""
        return tuple(name for name in KNOWN if name in self.curves and name not in UNSEARCHED)

    def end_diastolic_volume(self) -> float:
        """Of the left ventricle, m^3: the mean of the largest tenth of its volumes."""
        values = np.sort(self.curves["lv_volume"].values)
        return float(values[-max(1, values.size // 10) :].mean())

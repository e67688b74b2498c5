"""A periodic curve: one heart beat of volume or pressure."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from heartfit.errors import InputError

SMALLEST_NUMBER_OF_PHASES = 8
VOLUMES = (5e-6, 1e-3)  # m^3, a ventricle of a human: 5 mL to 1 L
PRESSURES = (-5e3, 40e3)  # Pa
VOLUME_MISTAKES = {"mL taken for m^3": 1e-6, "L taken for m^3": 1e-3, "L taken for mL": 1e3}
PRESSURE_MISTAKES = {"kPa taken for Pa": 1e3, "mmHg taken for Pa": 133.322, "mmHg taken for kPa": 0.133322}


@dataclass(frozen=True)
class Curve:
    """Values y(t) with y(t + period) = y(t).

    times (p,) s, increasing, spanning less than one period; values (p,) SI; period s.
    Raises InputError where one of these does not hold, or for fewer than eight samples.
    """

    times: np.ndarray
    values: np.ndarray
    period: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "times", np.asarray(self.times, dtype=float))
        object.__setattr__(self, "values", np.asarray(self.values, dtype=float))
        self._check_shape()
        self._check_times()

    def _check_shape(self) -> None:
        if self.times.ndim != 1 or self.times.shape != self.values.shape:
            raise InputError(
                f"curve: {self.times.shape} times and {self.values.shape} values; expected one value for "
                "each time"
            )
        if self.times.size < SMALLEST_NUMBER_OF_PHASES:
            raise InputError(
                f"curve: {self.times.size} samples; expected at least {SMALLEST_NUMBER_OF_PHASES} in a beat: "
                "peak rates mean nothing with fewer, so use a sequence with more phases"
            )
        for name, array in (("times", self.times), ("values", self.values)):
            if not np.isfinite(array).all():
                first = int(np.flatnonzero(~np.isfinite(array))[0])
                raise InputError(
                    f"curve: {name}[{first}] = {array[first]}; expected finite numbers: fill or drop the "
                    "sample"
                )

    def _check_times(self) -> None:
        if not (np.isfinite(self.period) and self.period > 0):
            raise InputError(f"curve: period = {self.period} s; expected a positive duration of the beat")
        steps = np.diff(self.times)
        if (steps <= 0).any():
            at = int(np.flatnonzero(steps <= 0)[0])
            raise InputError(
                f"curve: time goes from {self.times[at]:g} s to {self.times[at + 1]:g} s at sample {at + 1}; "
                "expected increasing times: sort the samples"
            )
        span = self.times[-1] - self.times[0]
        if span >= self.period * (1 - 1e-9):
            raise InputError(
                f"curve: the samples span {span:g} s, the period is {self.period:g} s; expected less than "
                "one "
                "period: drop the sample that repeats the first, or correct the period"
            )

    @classmethod
    def of_volume(cls, times: ArrayLike, values: ArrayLike, period: float) -> Self:
        """A cavity's volume in m^3; raises InputError for what no human ventricle can hold."""
        curve = cls(np.asarray(times), np.asarray(values), period)
        require_volumes(curve.values)
        return curve

    @classmethod
    def of_pressure(cls, times: ArrayLike, values: ArrayLike, period: float) -> Self:
        """A pressure in Pa; raises InputError for what no human heart bears."""
        curve = cls(np.asarray(times), np.asarray(values), period)
        require_pressures(curve.values)
        return curve

    def __call__(self, times: ArrayLike) -> np.ndarray:
        """Values at any times, linear between samples and periodic."""
        return np.interp(np.asarray(times), self.times, self.values, period=self.period)

    def shifted(self, start: float) -> Self:
        """The same curve with time zero at `start`."""
        return replace(self, times=self.times - start)

    def resampled(self, frames: int) -> Self:
        """The curve at `frames` equidistant times from time zero."""
        times = np.arange(frames) * (self.period / frames)
        return replace(self, times=times, values=self(times))


def require_volumes(values: np.ndarray) -> None:
    """Raise InputError for volumes, m^3, that no human ventricle can hold."""
    _check_range(values, VOLUMES, "volume", "m^3", VOLUME_MISTAKES)


def require_pressures(values: np.ndarray) -> None:
    """Raise InputError for pressures of a beat, Pa, that no human heart bears."""
    _check_range(values, PRESSURES, "pressure", "Pa", PRESSURE_MISTAKES)
    if np.abs(values).max() < 200.0:
        raise InputError(
            f"pressure: the largest value is {np.abs(values).max():g} Pa; expected kilopascals in a beat: probably "
            "kPa or mmHg taken for Pa: convert it"
        )


def _check_range(
    values: np.ndarray, bounds: tuple[float, float], name: str, unit: str, mistakes: dict[str, float]
) -> None:
    low, high = values.min(), values.max()
    if bounds[0] <= low and high <= bounds[1]:
        return
    guesses = [
        mistake
        for mistake, factor in mistakes.items()
        if bounds[0] <= low * factor and high * factor <= bounds[1]
    ]
    hint = f"probably {' or '.join(guesses)}: convert it" if guesses else "check the numbers"
    raise InputError(
        f"{name}: values from {low:g} to {high:g} {unit}; expected {bounds[0]:g} to {bounds[1]:g} {unit}; "
        f"{hint}"
    )

"""Periodic curve of one heart beat: volume, pressure or flow."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from heartfit.core.errors import InputError
from heartfit.core.parameter import DISPLAY

MIN_PHASES = 8
"""Fewest samples of a beat from which peak rates can be taken."""
VOLUME_RANGE = (5e-6, 1e-3)
"""Volumes of a human ventricle [m^3]: 5 mL to 1 L."""
PRESSURE_RANGE = (-5e3, 40e3)
"""Pressures of a human heart [Pa]."""
VOLUME_UNIT_MISTAKES = {"mL taken for m^3": 1e-6, "L taken for m^3": 1e-3, "L taken for mL": 1e3}
PRESSURE_UNIT_MISTAKES = {
    "kPa taken for Pa": 1e3,
    "mmHg taken for Pa": 133.322,
    "mmHg taken for kPa": 0.133322,
}


@dataclass(frozen=True)
class Curve:
    """Samples of y(t) with y(t + period) = y(t).

    times (p,): increasing [s], spanning less than one period; values (p,) [SI]; period [s].
    Raises InputError where one of these does not hold, or for fewer than MIN_PHASES samples.
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
                f"curve: {self.times.shape} times and {self.values.shape} values; "
                "expected one value for each time"
            )
        if self.times.size < MIN_PHASES:
            raise InputError(
                f"curve: {self.times.size} samples; expected at least {MIN_PHASES} in a beat: "
                "peak rates need more, so use a sequence with more phases"
            )
        for name, array in (("times", self.times), ("values", self.values)):
            if not np.isfinite(array).all():
                first = int(np.flatnonzero(~np.isfinite(array))[0])
                raise InputError(
                    f"curve: {name}[{first}] = {array[first]}; "
                    "expected finite numbers: fill or drop the sample"
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
                f"curve: the samples span {span:g} s, the period is {self.period:g} s; "
                "expected less than one period: drop the sample that repeats the first, or correct the period"
            )

    @classmethod
    def of_volume(cls, times: ArrayLike, values: ArrayLike, period: float) -> Self:
        """Curve of a cavity volume [m^3]; raises InputError outside VOLUME_RANGE."""
        curve = cls(np.asarray(times), np.asarray(values), period)
        require_volumes(curve.values)
        return curve

    @classmethod
    def of_pressure(cls, times: ArrayLike, values: ArrayLike, period: float) -> Self:
        """Curve of a pressure [Pa]; raises InputError outside PRESSURE_RANGE."""
        curve = cls(np.asarray(times), np.asarray(values), period)
        require_pressures(curve.values)
        return curve

    def __call__(self, times: ArrayLike) -> np.ndarray:
        """Values at any times [s], linear between samples and periodic."""
        return np.interp(np.asarray(times), self.times, self.values, period=self.period)

    def shifted(self, start: float) -> Self:
        """The same curve with time zero at `start`."""
        return replace(self, times=self.times - start)

    def resampled(self, frames: int) -> Self:
        """The curve at `frames` equidistant times from time zero."""
        times = np.arange(frames) * (self.period / frames)
        return replace(self, times=times, values=self(times))


def require_volumes(values: np.ndarray) -> None:
    """Raise InputError unless the volumes [m^3] lie in VOLUME_RANGE."""
    _check_range(values, VOLUME_RANGE, "volume", DISPLAY["m^3"], VOLUME_UNIT_MISTAKES)


def require_pressures(values: np.ndarray) -> None:
    """Raise InputError unless the pressures [Pa] of a beat lie in PRESSURE_RANGE and reach 200 Pa."""
    _check_range(values, PRESSURE_RANGE, "pressure", ("Pa", 1.0), PRESSURE_UNIT_MISTAKES)
    if np.abs(values).max() < 200.0:
        raise InputError(
            f"pressure: the largest value is {np.abs(values).max():g} Pa; expected kilopascals in a beat: probably "
            "kPa or mmHg taken for Pa: convert it"
        )


def _check_range(
    values: np.ndarray,
    bounds: tuple[float, float],
    name: str,
    printed: tuple[str, float],
    mistakes: dict[str, float],
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
    unit, size = printed
    least, most, low, high = (value / size for value in (*bounds, low, high))
    raise InputError(
        f"{name}: values from {low:g} to {high:g} {unit}; expected {least:g} to {most:g} {unit}; {hint}"
    )


def root_mean_square(measured: Curve, simulated: Curve, shift: float = 0.0) -> float:
    """Root mean square over the measured samples of y(t) - x(t + shift), in the unit of the curves."""
    return float(np.sqrt(np.mean((measured.values - simulated(measured.times + shift)) ** 2)))


def require_common_phase(measured: Curve, simulated: Curve) -> None:
    """Raise ValueError if the periods differ by more than a tenth: the phases of such beats do not correspond."""
    if abs(measured.period / simulated.period - 1) > 0.1:
        raise ValueError(
            f"alignment: periods of {measured.period:g} s and {simulated.period:g} s; "
            "expected the same heart rate: simulate at the measured period"
        )


def fit_shift(measured: Curve, simulated: Curve, limit: float | None = None) -> float:
    """Shift s [s], |s| <= limit (half a period if None), that minimises the root mean square of y(t) - x(t + s).

    A scan finds the basin, a bounded Brent search its minimum. Raises ValueError as `require_common_phase` does.
    """
    from scipy.optimize import minimize_scalar

    require_common_phase(measured, simulated)
    reach = simulated.period / 2 if limit is None else limit
    scan, step = np.linspace(-reach, reach, 101, retstep=True)
    start = min(scan, key=lambda shift: root_mean_square(measured, simulated, shift))
    bounds = (max(start - step, -reach), min(start + step, reach))
    fit = minimize_scalar(lambda shift: root_mean_square(measured, simulated, shift), bounds=bounds)
    return float(fit.x)


def fit_curves(
    measured: Mapping[str, Curve], simulated: Mapping[str, Curve], limit: float
) -> tuple[float, dict[str, float]]:
    """Shift [s], |s| <= limit, that fits the LV volume best, and the misfit of every common curve at that shift."""
    shift = fit_shift(measured["lv_volume"], simulated["lv_volume"], limit)
    common = [name for name in measured if name in simulated]
    return shift, {name: root_mean_square(measured[name], simulated[name], shift) for name in common}

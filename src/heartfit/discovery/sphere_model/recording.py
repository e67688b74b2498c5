"""Recordings of a heart, and their data for the search: averages and noise models.

Samples of a catheter are averaged over 10 ms of the phase, over all beats. The noise level of every curve is
unknown: it
is one of some levels, equally likely. Volumes err by 1 to 6 % of the end-diastolic volume, neighbours alike; a
catheter's samples by 0.3 kPa each. Roughness is the residual of any model, discrepancy that of a wrong one.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.inference.data import Block, Data, Noise
from heartfit.discovery.sphere_model.samples import BIN as BIN
from heartfit.discovery.sphere_model.samples import ROUNDING
from heartfit.discovery.sphere_model.samples import Samples as Samples
from heartfit.discovery.sphere_model.samples import averaged_by_phase as averaged_by_phase
from heartfit.heart.beat import Beat
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve, require_pressures, require_volumes
from heartfit.observation.second_reading import FrameNoise
from heartfit.roles import Sensor

KNOWN_CURVES = ("lv_volume", "lv_pressure", "aorta_pressure", "rv_volume", "rv_pressure")
"""Curves that a recording may contain."""
UNSEARCHED: Mapping[str, str] = dict.fromkeys(
    ("rv_volume", "rv_pressure"), "the sphere of the search has no right ventricle"
)
"""Curves that are kept but not searched unless both ventricles are, with the reason."""

FEWEST_SAMPLES, SHORTEST_SPAN = 8, 0.7
"""Least number of samples of a curve, and least part of the period that they span: less leaves a phase unobserved."""

LEAST_VARIATION = 0.05
"""Least difference of peak and trough of a beating curve, over its largest value."""

HUMAN_PERIODS = (0.25, 2.5)
"""Periods of a human heart [s]."""


@dataclass(frozen=True, eq=False, repr=False)
class Recording:
    """Curves by name, as in ``KNOWN_CURVES``, of a heart that beats with the ``period`` [s].

    noise: of curves whose noise was measured, by name; the levels of the others are unknown. unsearched: curves that no
    search uses, with the reason. balanced: both sides of the heart pump the same volume, which counts as a measurement.
    Raises InputError for a missing LV volume, an unknown or too short curve, and values outside the human range.
    """

    period: float
    curves: Mapping[str, Samples]
    noise: Mapping[str, FrameNoise] = field(default_factory=dict)
    unsearched: Mapping[str, str] = field(default_factory=lambda: UNSEARCHED)
    balanced: bool = False

    @classmethod
    def from_beat(cls, beat: Beat, sensors: Sequence[Sensor] = ()) -> Self:
        """Return the recording of a simulated beat without noise, its time zero at the R wave, as the sensors show it.

        Raises InputError for a failed beat.
        """
        if not beat.completed:
            raise InputError(f"recording: the beat failed ({beat.reason}); expected one that was completed")
        curves = beat_curves(beat, sensors)
        return cls(
            beat.period,
            {
                name: Samples.from_curve(curves[name]).from_trigger(beat.period)
                for name in KNOWN_CURVES
                if name in curves
            },
        )

    @classmethod
    def from_curves(cls, curves: Mapping[str, Curve]) -> Self:
        """Return the recording of curves of one period, such as those of a simulated or averaged beat."""
        period = next(iter(curves.values())).period
        return cls(period, {name: Samples.from_curve(curve) for name, curve in curves.items()})

    def __post_init__(self) -> None:
        if not HUMAN_PERIODS[0] < self.period < HUMAN_PERIODS[1]:
            raise InputError(
                f"period = {self.period:g} s; expected {HUMAN_PERIODS[0]:g} to {HUMAN_PERIODS[1]:g} s: "
                "state that of one beat"
            )
        if "lv_volume" not in self.curves:
            raise InputError(
                f"no lv_volume, found {', '.join(self.curves) or 'none'}; the volume of the left ventricle is needed: "
                "add it"
            )
        for name, samples in self.curves.items():
            self._check(name, samples)

    def __repr__(self) -> str:
        counts = (f"{name} {samples.times.size} samples" for name, samples in self.curves.items())
        return f"Recording({self.period:g} s: {', '.join(counts)})"

    def _check(self, name: str, samples: Samples) -> None:
        if name not in KNOWN_CURVES:
            raise InputError(f"{name} is not searched; known are {', '.join(KNOWN_CURVES)}: leave it out")
        span = float(np.ptp(samples.times)) if samples.times.size else 0.0
        if samples.times.size < FEWEST_SAMPLES or span < SHORTEST_SPAN * self.period:
            raise InputError(
                f"{name}: {samples.times.size} samples over {span:g} s; expected at least {FEWEST_SAMPLES} over "
                f"{SHORTEST_SPAN * self.period:.2g} s: record a whole beat of {self.period:g} s"
            )
        if samples.times.size * self.period < FEWEST_SAMPLES * span:
            raise InputError(
                f"{name}: {samples.times.size} samples over {span:g} s, {span / self.period:.0f} beats; expected at "
                f"least {FEWEST_SAMPLES} a beat: are the times milliseconds, or the period that of many beats?"
            )
        self._check_values(name, samples)

    def _check_values(self, name: str, samples: Samples) -> None:
        (require_volumes if name.endswith("_volume") else require_pressures)(samples.values)
        if np.ptp(samples.values) < LEAST_VARIATION * np.abs(samples.values).max():
            raise InputError(
                f"{name}: values from {samples.values.min():g} to {samples.values.max():g}, SI; expected a curve that "
                "beats: check the column"
            )

    def halves(self) -> "tuple[Recording, Recording | None]":
        """Return the half that a search fits and the half that judges what it names.

        Both hold the searched curves: every other beat or, of a single beat, every other frame and every other 50 ms of
        pressure; the first also holds the curves that are not searched, and the balance. A recording too short for two
        halves is returned whole, without a second one.
        """
        first = {name: _first_half(name, self.curves[name], self.period) for name in self.searched}
        whole = {name: samples for name, samples in self.curves.items() if name not in first}
        fitted = {name: self.curves[name].part(mask) for name, mask in first.items()}
        held = {name: self.curves[name].part(~mask) for name, mask in first.items()}
        try:
            return replace(self, curves=fitted | whole), replace(self, curves=held, balanced=False)
        except InputError:
            return self, None

    def with_pressure(self, pressure: Curve) -> "Recording":
        """Return the recording with a left ventricular pressure of another file; raises InputError if it has one."""
        if "lv_pressure" in self.curves:
            raise InputError(
                "lv_pressure is in the recording and in a file of its own; expected it in one: leave one out"
            )
        return replace(self, curves={**self.curves, "lv_pressure": Samples.from_curve(pressure)})

    def with_both_ventricles(self, balanced: bool = True) -> "Recording":
        """Return the recording with its right curves searched, and with balanced sides; without a volume, as it is."""
        if not {"lv_pressure", "rv_volume"} <= self.curves.keys():
            return self
        return replace(self, unsearched={}, balanced=balanced)

    def merged(self, other: "Recording") -> "Recording":
        """Return the recording with the samples of another one of the same beat."""
        merged = {name: self.curves[name].merged(samples) for name, samples in other.curves.items()}
        return replace(self, curves={**self.curves, **merged})

    @property
    def searched(self) -> tuple[str, ...]:
        """The curves that a search explains."""
        return tuple(name for name in KNOWN_CURVES if name in self.curves and name not in self.unsearched)

    def curve(self, name: str) -> Curve:
        """One beat of a curve; samples of several beats are averaged over 10 ms of the phase."""
        samples = self.curves[name]
        if np.ptp(samples.times) >= self.period * (1.0 - ROUNDING):
            samples = averaged_by_phase(samples, self.period, BIN)
        return Curve(samples.times, samples.values, self.period)

    def end_diastolic_volume(self, name: str = "lv_volume") -> float:
        """End-diastolic volume of a ventricle [m^3]: mean of the largest tenth of its volumes."""
        values = np.sort(self.curves[name].values)
        return float(values[-max(1, values.size // 10) :].mean())


BLOCK = 0.05
"""Length of a block of pressure samples that belong to the same half [s]."""


def _first_half(name: str, samples: Samples, period: float) -> np.ndarray:
    """Mask (k,) of the samples in the first half of a recording."""
    if np.ptp(samples.times) > 1.5 * period:
        return np.floor(samples.times / period).astype(int) % 2 == 0
    if name.endswith("_volume"):
        return np.arange(samples.times.size) % 2 == 0
    return np.floor(samples.times / BLOCK).astype(int) % 2 == 0


VOLUME_LEVELS, VOLUME_MEMORY = (0.008, 0.0133, 0.02, 0.028, 0.04, 0.056), 0.065
"""Noise levels of a frame over the end-diastolic volume, and their memory [s]."""
PRESSURE_LEVELS = (50.0, 100.0, 200.0)
"""Noise levels of a mean over 10 ms of one beat [Pa]."""
VOLUME_ROUGHNESS, PRESSURE_ROUGHNESS, ROUGHNESS_MEMORY = 0.004, 200.0, 0.1
"""Roughness over the end-diastolic volume, [Pa], and its memory [s]: on 12 hearts of another model without an
effect, the
evidence of the baseline is e^2 times that with 150 Pa and 50 ms, and the largest ln Bayes factor of an unknown effect
falls from 7.4 to 3.9."""
VOLUME_DISCREPANCY, PRESSURE_DISCREPANCY = 0.017, 500.0
"""Discrepancy of a wrong model, over the end-diastolic volume and [Pa]."""
RIGHT_PRESSURE = 0.3
"""Roughness and discrepancy of a right ventricular pressure over those of a left one, which is five times as large."""


BALANCE = "stroke_balance"
"""Volume that a beat takes out of the left atrium less that which it adds to the pulmonary artery [m^3]."""
BALANCE_SD = 0.02
"""Standard deviation of the balance over the end-diastolic volume: bronchial veins carry 1 % of the output, and a beat
differs from the next."""


def search_data(recording: Recording) -> Data:
    """Data of the search: one block for each searched curve, and one number for balanced sides."""
    kept = {name: _average(recording, name) for name in recording.searched}
    blocks = [_block(recording, name, samples.times) for name, samples in kept.items()]
    values = [samples.values for samples in kept.values()]
    if recording.balanced:
        sd = BALANCE_SD * recording.end_diastolic_volume()
        blocks.append(Block(BALANCE, "m^3", np.zeros(1), recording.period, Noise((sd,), 0.0, 0.0, 0.0)))
        values.append(np.zeros(1))
    return Data(np.concatenate(values), tuple(blocks))


def _average(recording: Recording, name: str) -> Samples:
    samples = recording.curves[name]
    if name.endswith("_volume") or not _needs_averaging(samples, recording.period):
        return samples
    return averaged_by_phase(samples, recording.period, BIN)


def _needs_averaging(samples: Samples, period: float) -> bool:
    """True if averaging leaves fewer numbers: samples closer than the bins, or several beats."""
    return samples.times.size > period / BIN + 1


def _block(recording: Recording, name: str, times: Floats) -> Block:
    if name.endswith("_volume"):
        size = recording.end_diastolic_volume(name)
        levels, memory = tuple(size * level for level in VOLUME_LEVELS), VOLUME_MEMORY
        if name in recording.noise:
            levels, memory = (recording.noise[name].deviation,), recording.noise[name].memory
        noise = Noise(levels, memory, size * VOLUME_ROUGHNESS, size * VOLUME_DISCREPANCY)
        return Block(name, "m^3", times, recording.period, noise)
    beats = max(1.0, np.ptp(recording.curves[name].times) / recording.period)
    levels = tuple(level / np.sqrt(beats) for level in PRESSURE_LEVELS)
    share = RIGHT_PRESSURE if name == "rv_pressure" else 1.0
    roughness, discrepancy = share * PRESSURE_ROUGHNESS, share * PRESSURE_DISCREPANCY
    noise = Noise(levels, 0.0, roughness, discrepancy, ROUGHNESS_MEMORY)
    return Block(name, "Pa", times, recording.period, noise)

"""Synthetic instruments: settings of a scanner, and a catheter."""

from dataclasses import astuple, dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.heart.beat import Beat


@dataclass(frozen=True)
class Contrast:
    """Brightness of the tissues in a balanced cine, blood = 1, and their texture.

    muscle_texture, lung_texture: standard deviation over the mean brightness; texture_length: standard deviation [m] of
    the Gaussian that smooths white noise into the texture.
    """

    blood: float = 1.0
    muscle: float = 0.4
    lung: float = 0.1
    fat: float = 0.75
    leaflets: float = 0.5
    muscle_texture: float = 0.2
    lung_texture: float = 0.3
    texture_length: float = 2.5e-3


@dataclass(frozen=True)
class Scanner:
    """Settings of a cine of short-axis slices across the long axis of the left ventricle.

    frames: per beat, equidistant from the trigger; voxel: width in the plane [m]; slice_thickness, slice_gap [m];
    signal_to_noise: brightness of blood over the standard deviation of the noise in either channel, whose magnitude is
    Rician; window: duration of a frame, over which it is blurred [s]; breath_hold_shift: standard deviation of the
    displacement of a slice in its plane, per direction [m]; margin: of the box around the heart [m]; subvoxel: largest
    distance of the samples that a voxel averages [m]; subframes: instants that a frame averages.
    """

    frames: int = 25
    voxel: float = 2e-3
    slice_thickness: float = 2e-3
    slice_gap: float = 0.0
    signal_to_noise: float = 30.0
    window: float = 0.03
    breath_hold_shift: float = 0.0
    contrast: Contrast = Contrast()
    margin: float = 14e-3
    subvoxel: float = 1e-3
    subframes: int = 3


@dataclass(frozen=True)
class Catheter:
    r"""Pressure line, ideal except for its sampling, noise and zero.

    .. math:: p'_j = p(t_j) + b + \epsilon_j, \qquad t_j = j / \mathrm{rate}, \quad
              b \sim N(0, \mathrm{offset}^2), \quad \epsilon_j \sim N(0, \mathrm{noise}^2)

    ``rate`` in [Hz]; ``noise`` and ``offset`` are standard deviations [Pa] of a sample and of the zero of a recording.
    Raises InputError for a rate that is not positive or a negative deviation.
    A distortion of the pressure curve is a sensor (:class:`heartfit.roles.Sensor`).
    """

    rate: float = 250.0
    noise: float = 100.0
    offset: float = 200.0

    def __post_init__(self) -> None:
        if not (np.isfinite(astuple(self)).all() and self.rate > 0 and self.noise >= 0 and self.offset >= 0):
            raise InputError(
                f"catheter: rate {self.rate:g} Hz, noise {self.noise:g} Pa, offset {self.offset:g} Pa; expected a "
                "positive rate and deviations of at least zero"
            )

    def record(self, beat: Beat, seed: int) -> tuple[Floats, Floats, float]:
        """Record the "lv" pressure: times after the trigger (j,) [s], pressures (j,) [Pa], period [s].

        Raises InputError for a failed beat.
        """
        if not beat.completed:
            raise InputError(f"catheter: the beat failed ({beat.reason}); expected a completed beat")
        random = np.random.default_rng(seed)
        times = np.arange(np.ceil(beat.period * self.rate * (1 - 1e-9))) / self.rate
        true = np.interp(times + beat.trigger, beat.time, beat.pressure["lv"], period=beat.period)
        zero = self.offset * random.standard_normal()
        return times, true + zero + self.noise * random.standard_normal(times.size), beat.period

"""The pressure record of a virtual volunteer, as a catheter in the left ventricle would give it."""

from dataclasses import astuple, dataclass

import numpy as np

from heartfit.beat import Beat
from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats


@dataclass(frozen=True)
class Catheter:
    r"""An ideal pressure line but for its sampling, noise and zero.

    .. math:: p'_j = p(t_j) + b + \epsilon_j, \qquad t_j = j / \mathrm{rate}, \quad
              b \sim N(0, \mathrm{offset}^2), \quad \epsilon_j \sim N(0, \mathrm{noise}^2)

    ``rate`` in Hz; ``noise`` and ``offset`` are standard deviations in Pa, the one of every sample, the other drawn
    once for a recording. Raises InputError for a rate that is not positive or a negative deviation.
    What distorts the pressure's form is a sensor (:class:`heartfit.mechanism.Sensor`).
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
        """Times (j,), s after the trigger, pressures (j,), Pa, of one period, s, from the beat's "lv" pressure.

        Raises InputError for a beat that failed.
        """
        if not beat.completed:
            raise InputError(f"catheter: the beat failed ({beat.reason}); expected a completed one")
        random = np.random.default_rng(seed)
        times = np.arange(np.ceil(beat.period * self.rate * (1 - 1e-9))) / self.rate
        true = np.interp(times + beat.trigger, beat.time, beat.pressure["lv"], period=beat.period)
        zero = self.offset * random.standard_normal()
        return times, true + zero + self.noise * random.standard_normal(times.size), beat.period

"""Effects outside the library: nothing that may be named explains them, so the verdict must be unknown.

They play the roles of mechanisms, but are not registered. Their sizes are as a cardiologist or an engineer meets them.
"""

from dataclasses import dataclass, replace

import numpy as np

from heartfit.branch import Branch
from heartfit.electrophysiology.control import Control
from heartfit.geometry.arrays import Floats
from heartfit.heart import Heart
from heartfit.load import Load
from heartfit.mechanism import External, Flow, Mechanism, Sensor
from heartfit.parameter import parameter, parameters_of
from heartfit.periodic import bump


@dataclass(frozen=True)
class SeptalDefect(Flow):
    """Blood shunted from the left ventricle to the right one through a hole in the septum, an orifice."""

    upstream = "lv"
    downstream = "rv"
    area: float = parameter(
        0.2e-4, unit="m^2", symbol="A", meaning="area of the defect", off=0.0, scale=0.1e-4
    )

    def law(self, time: Floats) -> Branch:  # noqa: ARG002
        return Branch(area=self.area, back_area=self.area)


@dataclass(frozen=True)
class CurvedVolume(Sensor):
    r"""A volume that is not linear in the true one, right where it is largest and least.

    .. math:: V' = V + 4 a \frac{(V_{max} - V)(V - V_{min})}{V_{max} - V_{min}}
    """

    measures = ("lv_volume",)
    bow: float = parameter(
        0.05,
        unit="1",
        symbol="a",
        meaning="largest error over the stroke volume",
        off=0.0,
        low=-1.0,
        scale=0.05,
    )

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:  # noqa: ARG002
        high, low = values.max(), values.min()
        return values + 4.0 * self.bow * (high - values) * (values - low) / (high - low)


@dataclass(frozen=True)
class CatheterWhip(Sensor):
    r"""A catheter that is struck as the pressure rises, and rings.

    .. math:: P' = P + a\, e^{-(t - t_s)/\tau} \sin 2 \pi f (t - t_s), \quad t \ge t_s,

    with f = 9 Hz, :math:`\tau` = 0.1 s and :math:`t_s` the time of the steepest rise. A resonant line also rings
    as the pressure falls, this one does not.
    """

    measures = ("lv_pressure",)
    ring: float = parameter(
        600.0, unit="Pa", symbol="a", meaning="first amplitude of the ringing", off=0.0, scale=500.0
    )
    frequency: float = parameter(9.0, unit="Hz", symbol="f", meaning="frequency of the ringing")
    decay: float = parameter(0.1, unit="s", symbol=r"\tau", meaning="time in which it decays")

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        struck = times[int(np.argmax(np.gradient(values, times)))]
        since = np.mod(times - struck, period)
        return values + self.ring * np.exp(-since / self.decay) * np.sin(2.0 * np.pi * self.frequency * since)


@dataclass(frozen=True)
class ThoracicPulse(External):
    """A pulse of pressure around the heart in diastole: a strained breath in every beat."""

    pressure: float = parameter(
        1000.0, unit="Pa", symbol="a", meaning="greatest pressure around the heart", off=0.0, scale=800.0
    )
    peak: float = parameter(0.64, unit="s", symbol="t_s", meaning="time of the maximum", scale=0.02)
    width: float = parameter(0.25, unit="s", symbol="w", meaning="length of the pulse", low=0.05)

    def load(self, ventricle: str, time: Floats, period: float) -> Load:  # noqa: ARG002
        return Load(pulse=self.pressure * bump(time, self.peak, self.width, period))


@dataclass(frozen=True)
class Obliteration(External):
    r"""A cavity whose walls meet as it empties, so that pressure is trapped in it: an obstruction by volume.

    .. math:: p = a\, e^{(V_0 - V) / v}
    """

    pressure: float = parameter(
        2000.0,
        unit="Pa",
        symbol="a",
        meaning="trapped pressure at the reference volume",
        off=0.0,
        scale=1500.0,
    )
    volume: float = parameter(60e-6, unit="m^3", symbol="V_0", meaning="reference volume", sd=0.1)
    scale: float = parameter(25e-6, unit="m^3", symbol="v", meaning="volume over which it falls e-fold")

    def load(self, ventricle: str, time: Floats, period: float) -> Load:  # noqa: ARG002
        return Load(rise=self.pressure, volume=self.volume, scale=-self.scale)


@dataclass(frozen=True)
class TwitchingControl(Control):
    """The control of fibres of which a share contracts a second time."""

    share: float = 0.0
    pause: float = 0.15
    lasts: float = 0.1

    def _depolarised(self, start: Floats | float, dt: float, activation: Floats, period: float) -> Floats:
        again = replace(self, share=0.0, duration=self.lasts, onset=self.onset + self.duration + self.pause)
        first = super()._depolarised(start, dt, activation, period)
        if self.share == 0.0:
            return first
        return first + self.share * again._depolarised(start, dt, activation, period)


@dataclass(frozen=True)
class SecondTwitch(Mechanism):
    """A share of the depolarisation comes a second time, in early diastole: an after-contraction."""

    share: float = parameter(
        0.2, unit="1", symbol="a", meaning="size of the second twitch over the first", off=0.0, scale=0.1
    )
    pause: float = parameter(0.15, unit="s", symbol="t_2", meaning="from the end of the first", scale=0.03)


OUTSIDERS: tuple[type[Mechanism], ...] = (
    SeptalDefect, CurvedVolume, CatheterWhip, ThoracicPulse, Obliteration, SecondTwitch,
)  # fmt: skip


def joined(heart: Heart, effect: Mechanism) -> Heart:
    """The heart with an effect, of the library or from outside it."""
    if not isinstance(effect, SecondTwitch):
        return heart + effect
    control = heart.tissue.control
    known = {each.name: each.value for each in parameters_of(control)}
    twitching = TwitchingControl(**known, share=effect.share, pause=effect.pause)  # type: ignore[arg-type]
    return replace(heart, tissue=replace(heart.tissue, control=twitching)) + effect

"""Out-of-library effects: no mechanism of the library explains them, so the correct verdict is "unknown".

They play the roles of mechanisms but are not registered. Their default sizes are realistic for a cardiologist or an
engineer.
"""

from dataclasses import dataclass, replace

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, parameters_of
from heartfit.core.periodic import bump
from heartfit.heart.heart import Heart
from heartfit.heart.muscle.control import Control
from heartfit.roles import External, Flow, Mechanism, Sensor
from heartfit.roles.laws import Branch, Load


@dataclass(frozen=True)
class SeptalDefect(Flow):
    """Ventricular septal defect: an orifice that shunts blood from the left to the right ventricle."""

    upstream = "lv"
    downstream = "rv"
    area: float = parameter(
        0.2e-4, unit="m^2", symbol="A", meaning="area of the defect", off=0.0, scale=0.1e-4
    )

    def law(self, time: Floats) -> Branch:  # noqa: ARG002
        return Branch(area=self.area, back_area=self.area)


@dataclass(frozen=True)
class CurvedVolume(Sensor):
    r"""Measured volume that is non-linear in the true one and exact at its maximum and minimum.

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
    r"""Catheter whip: the line is struck at the steepest rise of the pressure and rings.

    .. math:: P' = P + a\, e^{-(t - t_s)/\tau} \sin 2 \pi f (t - t_s), \quad t \ge t_s,

    with f = 9 Hz, :math:`\tau` = 0.1 s and :math:`t_s` the time of the steepest rise. Unlike a resonant line, it
    does not ring as the pressure falls.
    """

    measures = ("lv_pressure",)
    ring: float = parameter(
        600.0, unit="Pa", symbol="a", meaning="first amplitude of the ringing", off=0.0, scale=500.0
    )
    frequency: float = parameter(9.0, unit="Hz", symbol="f", meaning="frequency of the ringing")
    decay: float = parameter(0.1, unit="s", symbol=r"\tau", meaning="time in which it decays")

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        strike = times[int(np.argmax(np.gradient(values, times)))]
        since = np.mod(times - strike, period)
        return values + self.ring * np.exp(-since / self.decay) * np.sin(2.0 * np.pi * self.frequency * since)


@dataclass(frozen=True)
class ThoracicPulse(External):
    """Pulse of intrathoracic pressure around the heart in diastole, as of a strained breath in every beat."""

    pressure: float = parameter(
        1000.0, unit="Pa", symbol="a", meaning="greatest pressure around the heart", off=0.0, scale=800.0
    )
    peak: float = parameter(0.64, unit="s", symbol="t_s", meaning="time of the maximum", scale=0.02)
    width: float = parameter(0.25, unit="s", symbol="w", meaning="length of the pulse", low=0.05)

    def load(self, ventricle: str, time: Floats, period: float) -> Load:  # noqa: ARG002
        return Load(pulse=self.pressure * bump(time, self.peak, self.width, period))


@dataclass(frozen=True)
class Obliteration(External):
    r"""Cavity obliteration: the walls meet as the cavity empties and trap a pressure that depends on its volume.

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
    """Excitation-contraction control with a second depolarisation of a share of the fibres."""

    share: float = 0.0
    pause: float = 0.15
    second_duration: float = 0.1

    def _depolarised(self, start: Floats | float, dt: float, activation: Floats, period: float) -> Floats:
        second = replace(
            self, share=0.0, duration=self.second_duration, onset=self.onset + self.duration + self.pause
        )
        first = super()._depolarised(start, dt, activation, period)
        if self.share == 0.0:
            return first
        return first + self.share * second._depolarised(start, dt, activation, period)


@dataclass(frozen=True)
class SecondTwitch(Mechanism):
    """After-contraction: a share of the depolarisation recurs in early diastole."""

    share: float = parameter(
        0.2, unit="1", symbol="a", meaning="size of the second twitch over the first", off=0.0, scale=0.1
    )
    pause: float = parameter(0.15, unit="s", symbol="t_2", meaning="from the end of the first", scale=0.03)


OUT_OF_LIBRARY: tuple[type[Mechanism], ...] = (
    SeptalDefect, CurvedVolume, CatheterWhip, ThoracicPulse, Obliteration, SecondTwitch,
)  # fmt: skip


def add_effect(heart: Heart, effect: Mechanism) -> Heart:
    """Return the heart with an effect of the library or from outside it."""
    if not isinstance(effect, SecondTwitch):
        return heart + effect
    control = heart.tissue.control
    values = {parameter.name: parameter.value for parameter in parameters_of(control)}
    twitching = TwitchingControl(**values, share=effect.share, pause=effect.pause)  # type: ignore[arg-type]
    return replace(heart, tissue=replace(heart.tissue, control=twitching)) + effect

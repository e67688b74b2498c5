r"""Laws that the function of a place may follow, each with one size.

A law gives the function as theta times a curve of the state of the beat: a conductance times a pressure drop, an
orifice times its root. Some laws have a shape, such as the time of a pulse, of which several are tried.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import product

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.periodic import bump
from heartfit.places.library import (
    AorticPressure,
    AtrialPressure,
    Backflow,
    LeakFlow,
    PressureError,
    VolumeError,
)
from heartfit.places.place import FunctionOfTime, Region
from heartfit.places.wall import AttachmentRate, WallPressure
from heartfit.roles.laws import BLOOD_DENSITY

TIME_FORMS: Mapping[Region, type[FunctionOfTime]] = {
    place.region: place
    for place in (
        *(AtrialPressure, AorticPressure, LeakFlow, Backflow, WallPressure, AttachmentRate),
        *(VolumeError, PressureError),
    )
}
"""The place of each region whose function of time shows what acts there."""
CENTRES, WIDTHS = 24, (0.08, 0.16, 0.3)
"""Number of times of a pulse within the beat, and its lengths from foot to foot [s]."""
GROWTHS = (10e-6, 25e-6, 60e-6)
"""Volumes over which an exponential grows e-fold [m^3]."""
RINGS = tuple(product((6.0, 9.0, 12.0), (0.05, 0.1)))
"""Frequencies [Hz] and decay times [s] of a ringing."""


@dataclass(frozen=True)
class LawState:
    """Signals (k,) [SI] of a beat by name, as "lv_pressure", at equidistant ``times`` (k,) [s] of a function.

    period [s]; the times begin with the function's zero.
    """

    times: Floats
    signals: Mapping[str, Floats]
    period: float

    def rate(self, name: str) -> Floats:
        """Return the time derivative (k,) of a signal."""
        values = self.signals[name]
        step = self.period / values.size
        return (np.roll(values, -1) - np.roll(values, 1)) / (2.0 * step)

    def drop(self, upstream: str, downstream: str) -> Floats:
        """Return the forward pressure drop (k,) between two compartments [Pa], zero where it is backward."""
        return np.maximum(self.signals[f"{upstream}_pressure"] - self.signals[f"{downstream}_pressure"], 0.0)


@dataclass(frozen=True, eq=False)
class Law:
    """A law of one size theta, in ``unit``, of the typical size ``scale``.

    curves (shapes, k): the function for theta = 1; shapes: the other constants of each by name [SI]; formula: LaTeX.
    """

    name: str
    formula: str
    unit: str
    scale: float
    curves: Floats
    shapes: tuple[Mapping[str, float], ...] = ({},)
    one_sided: bool = True


def laws_of(region: Region, state: LawState) -> tuple[Law, ...]:
    """Return the laws that the function of a region may follow."""
    return (*SPECIFIC[region](state), pulse(region, state))


def pulse(region: Region, state: LawState) -> Law:
    """Return a pulse in time, of any sign; of the muscle, whose rates are not negative, a positive one."""
    place = TIME_FORMS[region]
    centres = state.times[0] + state.period * np.arange(CENTRES) / CENTRES
    shapes = tuple({"centre": float(c), "width": w} for c in centres for w in WIDTHS)
    curves = [bump(state.times, shape["centre"], shape["width"], state.period) for shape in shapes]
    return Law(
        "pulse", r"a\,\cos^2 \pi (t - t_c)/w", place.unit, place.amplitude, np.array(curves), shapes,
        one_sided=region == "muscle",
    )  # fmt: skip


def _passages(upstream: str, downstream: str) -> Callable[[LawState], tuple[Law, ...]]:
    def laws(state: LawState) -> tuple[Law, ...]:
        drop = state.drop(upstream, downstream)
        return (
            Law("conductance", r"K \Delta p", "m^3/(s Pa)", 1e-8, drop[None]),
            Law(
                "orifice",
                r"A \sqrt{2 \Delta p / \rho}",
                "m^2",
                0.2e-4,
                np.sqrt(2.0 * drop / BLOOD_DENSITY)[None],
            ),
        )

    return laws


def _filling(state: LawState) -> tuple[Law, ...]:
    flow = np.maximum(state.signals["mitral_flow"], 0.0)
    return (Law("loss", r"-\tfrac12 \rho a q^2", "1/m^4", 1e8, -0.5 * BLOOD_DENSITY * flow[None] ** 2),)


def _ejection(state: LawState) -> tuple[Law, ...]:
    flow = np.maximum(state.signals["aortic_flow"], 0.0)
    return (Law("loss", r"\tfrac12 \rho a q^2", "1/m^4", 1e8, 0.5 * BLOOD_DENSITY * flow[None] ** 2),)


def _wall(state: LawState) -> tuple[Law, ...]:
    volume = state.signals["lv_volume"]

    def exponential(name: str, sign: float, at: float) -> Law:
        curves = np.exp(
            sign * np.subtract.outer(np.zeros(len(GROWTHS)), at - volume) / np.array(GROWTHS)[:, None]
        )
        shapes = tuple({"volume": at, "growth": sign * growth} for growth in GROWTHS)
        return Law(name, r"a\, e^{(V - V_0)/v}", "Pa", 1000.0, curves, shapes)

    return (
        exponential("stiffening", 1.0, float(volume.max())),
        exponential("obliteration", -1.0, float(volume.min())),
    )


def _muscle(state: LawState) -> tuple[Law, ...]:  # noqa: ARG001
    return ()


def _images(state: LawState) -> tuple[Law, ...]:
    volume = state.signals["lv_volume"]
    high, low = volume.max(), volume.min()
    bow = 4.0 * (high - volume) * (volume - low) / (high - low)
    return (
        Law("gain", r"g (V - \bar V)", "1", 0.1, (volume - volume.mean())[None], one_sided=False),
        Law(
            "bow",
            r"4 a (V_{max} - V)(V - V_{min})/(V_{max} - V_{min})",
            "1",
            0.05,
            bow[None],
            one_sided=False,
        ),
        Law("delay", r"-d\, \dot V", "s", 0.02, -state.rate("lv_volume")[None], one_sided=False),
    )


def _catheter(state: LawState) -> tuple[Law, ...]:
    pressure = state.signals["lv_pressure"]
    shapes = tuple({"frequency": f, "decay": d} for f, d in RINGS)
    strike = state.times[int(np.argmax(state.rate("lv_pressure")))]
    since = np.mod(state.times - strike, state.period)
    rings = [np.exp(-since / d) * np.sin(2.0 * np.pi * f * since) for f, d in RINGS]
    return (
        Law("gain", r"g (p - p_{min})", "1", 0.05, (pressure - pressure.min())[None], one_sided=False),
        Law("offset", "p_0", "Pa", 300.0, np.ones((1, pressure.size)), one_sided=False),
        Law("delay", r"-d\, \dot p", "s", 0.01, -state.rate("lv_pressure")[None], one_sided=False),
        Law(
            "ringing",
            r"a\, e^{-t/\tau} \sin 2 \pi f t",
            "Pa",
            500.0,
            np.array(rings),
            shapes,
            one_sided=False,
        ),
    )


SPECIFIC: Mapping[Region, Callable[[LawState], tuple[Law, ...]]] = {
    "filling": _filling,
    "ejection": _ejection,
    "leak": _passages("lv", "left_atrium"),
    "backflow": _passages("aorta", "lv"),
    "wall": _wall,
    "muscle": _muscle,
    "images": _images,
    "catheter": _catheter,
}
"""Laws of each region other than the pulse."""

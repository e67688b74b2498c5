"""Recover hidden functions inside the equations: python -m benchmarks.recovered_functions

Four hidden hearts, each with one effect whose entry the library lacks. Writes docs/figures/recovered_functions.png with
those whose right region leads; three minutes.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from benchmarks.ventricles import ROOT
from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.cause import PlaceFunction
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.heart.beat import Beat
from heartfit.io.figures import write_figure
from heartfit.mechanisms.arterial_reflection import ArterialReflection
from heartfit.observation.beat import beat_curves
from heartfit.places import PLACES, regions_of
from heartfit.results.acting_figure import plot_with_band
from heartfit.results.acting_places import acts
from heartfit.results.figures import MEASURED
from heartfit.roles import Mechanism
from heartfit.synthetic.hidden import RecordingProtocol, draw_hidden, measure_beat
from heartfit.synthetic.out_of_library import CatheterWhip, SeptalDefect, ThoracicPulse

Hidden = Callable[[Beat, Floats, float], Floats]
"""A hidden function of the beat at simulated times (k,) [s] and of the time of the trigger [s]."""
WAVE, PULSE, WHIP = ArterialReflection(wave=2500.0), ThoracicPulse(pressure=2400.0), CatheterWhip(ring=1500.0)


@dataclass(frozen=True)
class Planted:
    """A hidden effect, its function, the entry that the library lacks, and the seed of the heart."""

    effect: Mechanism
    function: Hidden
    left_out: tuple[str, ...]
    seed: int


@dataclass(frozen=True, eq=False)
class Recovered:
    """A function with its posterior, and the hidden one (k,) at the same times in the same unit."""

    function: PlaceFunction
    hidden: Floats

    def correlation(self) -> float:
        """Return the correlation of both over the beat, every time weighted by the inverse of the variance."""
        weights = self.function.sd**-2 / np.sum(self.function.sd**-2)
        one, other = (values - np.sum(weights * values) for values in (self.function.mean, self.hidden))
        covariance = np.sum(weights * one * other)
        return float(covariance / np.sqrt(np.sum(weights * one**2) * np.sum(weights * other**2)))


def defect(beat: Beat, times: Floats, trigger: float) -> Floats:
    """Return the flow through the defect [m^3/s]."""
    return np.interp(times, beat.time, beat.flow["SeptalDefect"], period=beat.period)


def wave(beat: Beat, times: Floats, trigger: float) -> Floats:
    """Return the pressure of the reflected wave [Pa]."""
    return WAVE.pressure("aorta", times, beat.period)


def pulse(beat: Beat, times: Floats, trigger: float) -> Floats:
    """Return the pressure around the heart [Pa]."""
    return np.asarray(PULSE.load("lv", times, beat.period).pulse)


def whip(beat: Beat, times: Floats, trigger: float) -> Floats:
    """Return the error of the catheter [Pa]."""
    true = beat_curves(beat)["lv_pressure"]
    phases = np.arange(400) * beat.period / 400
    values = true(phases)
    error = WHIP.distort(phases, values, beat.period) - values
    return np.interp(times - trigger, phases, error, period=beat.period)


PLANTED = {
    "septal defect": Planted(SeptalDefect(area=0.4e-4), defect, ("MitralRegurgitation",), 3),
    "reflected wave": Planted(WAVE, wave, ("ArterialReflection",), 4),
    "thoracic pulse": Planted(PULSE, pulse, (), 5),
    "catheter whip": Planted(WHIP, whip, (), 6),
}


def main() -> None:
    """Search all hearts and draw the figure of those whose right region leads."""
    recovered = {name: recover(planted) for name, planted in PLANTED.items()}
    functions = {name: one for name, one in recovered.items() if one is not None}
    write_figure(ROOT / "docs" / "figures" / "recovered_functions.png", plot_recovered(functions))


def recover(planted: Planted) -> Recovered | None:
    """Return the function of the leading region beside the hidden one; None where it is a wrong one."""
    rng = np.random.default_rng(planted.seed)
    heart = draw_hidden(rng).with_effects([planted.effect])
    beat = heart.beat()
    sensors = heart.heart.sensors
    recording = Recording.from_curves(measure_beat(beat, sensors, RecordingProtocol.draw(rng), rng))
    diagnosed = diagnose(recording, places=PLACES, left_out=planted.left_out)
    print(planted.effect, diagnosed.verdict, [(one.region, one.ln_bayes_factor) for one in diagnosed.acting])
    if not diagnosed.acting or diagnosed.acting[0].region not in regions_of(type(planted.effect)):
        return None
    function, trigger = diagnosed.functions[0], heart.heart.trigger
    return Recovered(function, planted.function(beat, function.times + trigger, trigger))


def plot_recovered(functions: Mapping[str, Recovered]) -> Figure:
    """Plot a panel for each hidden effect: the hidden function, and the recovered one with its 95 % band."""
    figure = Figure(figsize=(3.6 * len(functions), 3.4), layout="constrained")
    panels = figure.subplots(1, len(functions), squeeze=False)[0]
    for axes, (name, one) in zip(panels, functions.items(), strict=True):
        _plot_one(axes, name, one)
    panels[0].legend(frameon=False, fontsize=8)
    return figure


def _plot_one(axes: Axes, name: str, one: Recovered) -> None:
    plot_with_band(axes, one.function, one.hidden, "hidden", MEASURED)
    region, r = acts(one.function.region), one.correlation()
    axes.set_title(f"{name}: acts\n{region}, r = {r:.2f}", fontsize=9, fontweight="bold")


if __name__ == "__main__":
    main()

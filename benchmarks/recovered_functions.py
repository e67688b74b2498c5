"""Recover hidden functions inside the equations: python -m benchmarks.recovered_functions

Four hidden hearts, each with one effect whose entry the library lacks. Writes docs/figures/recovered_functions.png with
those whose right region leads; three minutes.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from benchmarks.ventricles import ROOT
from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.heart.beat import Beat
from heartfit.io.figures import write_figure
from heartfit.mechanisms.arterial_reflection import ArterialReflection
from heartfit.observation.beat import beat_curves
from heartfit.places import PLACES, regions_of
from heartfit.results.recovered import Recovered, plot_recovered
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


if __name__ == "__main__":
    main()

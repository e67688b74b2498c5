"""Which further measurement would tell explanations apart that the recording does not, and what it is expected to say.

Another loading, the pressure of the aorta or the flow through a valve is predicted by every explanation, with what each
leaves open; see :mod:`heartfit.discovery.plan`.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from heartfit.diagnosis.centre import Centre
from heartfit.diagnosis.library import Candidate, hypothesis
from heartfit.diagnosis.twin import Twin
from heartfit.discovery.data import Block, Data, Noise
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.plan import ENOUGH, Measurement, Prospect, plan
from heartfit.geometry.arrays import Floats

PRESSURE = "the left ventricular pressure over a beat: the volume alone shows one in nine effects"


@dataclass(frozen=True)
class Option:
    """A measurement in words, its cost, by what it changes the heart, and curves it adds to those recorded."""

    name: str
    cost: float
    load: Mapping[str, float] = field(default_factory=dict)
    curves: tuple[str, ...] = ()


OPTIONS = (
    Option("the flow through the mitral valve", 1.0, curves=("mitral_flow",)),
    Option("the flow through the aortic valve", 1.0, curves=("aortic_flow",)),
    Option("the same curves with the legs raised", 2.0, {"circulation.left_atrium": 1.3}),
    Option("the same curves while a hand is squeezed", 2.0, {"circulation.systemic.R_p": 1.25}),
    Option("the pressure of the aorta", 3.0, curves=("aorta_pressure",)),
)
"""Costs in echocardiograms."""
NOISES = {
    "flow": Noise((30e-6,), 0.02, 15e-6, 60e-6),
    "pressure": Noise((100.0,), 0.0, 200.0, 500.0, 0.1),
}
"""m^3/s of Doppler or phase contrast, Pa of a catheter."""
TIMES = 40


def next_measurement(
    centre: Centre, data: Data, library: Mapping[str, Candidate], rivals: Sequence[Explanation]
) -> str:
    """The cheapest option that is expected to decide between the explanations, in a sentence; else the best one."""
    options = [_measurement(each, centre, data, library) for each in OPTIONS]
    prospects = plan(rivals, options)
    return _said(prospects[0]) if prospects else ""


def _said(best: Prospect) -> str:
    expected = f"the simulation expects a ln Bayes factor of {best.gain:.1f}"
    return f"{best.name}: {expected}" + (
        "" if best.gain >= ENOUGH else f", below {ENOUGH:g}: no measurement tried decides"
    )


def _measurement(option: Option, centre: Centre, data: Data, library: Mapping[str, Candidate]) -> Measurement:
    changed = {path: factor * centre.values[path] for path, factor in option.load.items()}
    loaded = replace(centre, heart=centre.heart.with_parameters(changed))
    period = centre.heart.period
    blocks = tuple(_block(name, period) for name in option.curves) or data.blocks

    def forward(effects: tuple[str, ...]) -> Callable[[Floats], Floats | None]:
        twin = Twin(loaded, {block.curve: block.times for block in blocks})
        return hypothesis(twin, tuple(library[name] for name in effects)).forward

    return Measurement(option.name, option.cost, blocks, forward)


def _block(name: str, period: float) -> Block:
    kind = name.rsplit("_", 1)[1]
    unit = "m^3/s" if kind == "flow" else "Pa"
    return Block(name, unit, np.arange(TIMES) * period / TIMES, period, NOISES[kind])

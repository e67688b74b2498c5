"""Detection limits of the library, and the next measurement to take.

The detection limit of an effect is the size at which it shows in a volume and a pressure, see
:mod:`heartfit.discovery.inference.plan`. The hearts are the nominal one and others drawn from the priors; each is
recorded as a study would record it.

The next measurement is the one that tells explanations apart that the recording does not: every explanation predicts
another loading, the pressure of the aorta or the flow through a valve, with the uncertainty that it leaves.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import Parameter
from heartfit.discovery.inference.data import Block, Data, Noise
from heartfit.discovery.inference.decide import DEFAULT_RULES
from heartfit.discovery.inference.evidence import Explanation
from heartfit.discovery.inference.plan import (
    DECISIVE,
    FurtherMeasurement,
    Prospect,
    expected_log_bayes_factor,
    plan,
    threshold_crossing,
)
from heartfit.discovery.sphere_model.forward_model import (
    NUMERICS,
    Candidate,
    SphereForwardModel,
    candidates,
    hypothesis,
)
from heartfit.discovery.sphere_model.nominal_heart import ADULT, NominalHeart
from heartfit.discovery.sphere_model.recording import BALANCE, Recording, Samples, search_data

SIZES = (1.0, 2.0, 3.0, 4.0)
"""Amplitudes [scales of the mechanism]."""
FRAMES, RATE = 28, 1000.0
"""Frames of the volume per beat; sampling rate of the pressure [1/s]."""
LEFT_CURVES = ("lv_volume", "lv_pressure")


@dataclass(frozen=True)
class DetectionLimit:
    """Median ln Bayes factors of an effect over the hearts, one for each of ``SIZES``.

    sign: of the amplitude; least: the detection limit [scales], None beyond the largest size.
    """

    name: str
    switch: Parameter
    sign: float
    factors: tuple[float, ...]
    least: float | None

    @property
    def amplitude(self) -> float | None:
        """The detection limit [SI]."""
        return None if self.least is None else self.switch.at(self.sign * self.least)


def detection_limits(
    hearts: int,
    nominal: NominalHeart = ADULT,
    names: Sequence[str] = (),
    threshold: float = DEFAULT_RULES.detected,
    curves: Sequence[str] = LEFT_CURVES,
) -> Iterator[DetectionLimit]:
    """Detection limits of all mechanisms, or of those named, for both signs of a two-sided amplitude.

    curves: that are recorded; those of the right ventricle of a nominal heart that has one.
    """
    planned = _PlannedRecording(nominal, curves)
    free = len(planned.model.base)
    drawn = [np.zeros(free), *np.random.default_rng(0).standard_normal((hearts - 1, free))]
    for name, candidate in _select(planned.candidates, names).items():
        switch = candidate.unknowns[0]
        for sign in (1.0,) if switch.one_sided else (1.0, -1.0):
            by_heart = [
                [planned.log_bayes_factor(candidate, sign * size, heart) for size in SIZES] for heart in drawn
            ]
            factors = tuple(np.nanmedian(by_heart, axis=0).tolist())
            yield DetectionLimit(name, switch, sign, factors, threshold_crossing(SIZES, factors, threshold))


def expected_evidence(name: str, scales: float) -> float:
    """Expected ln Bayes factor of a mechanism of a signed size [scales] in a recording of the average adult."""
    planned = _PlannedRecording(ADULT, LEFT_CURVES)
    return planned.log_bayes_factor(planned.candidates[name], scales, np.zeros(len(planned.model.base)))


class _PlannedRecording:
    """The samples of a nominal heart that a search would see, one half of a recording, and what they would show."""

    def __init__(self, nominal: NominalHeart, curves: Sequence[str]) -> None:
        self.blocks = search_data(_sample_recording(nominal, curves).halves()[0]).blocks
        self.model = SphereForwardModel.at_samples(nominal, self.blocks)
        self.candidates = candidates(self.model)

    def log_bayes_factor(self, candidate: Candidate, amplitude: float, heart: Floats) -> float:
        """Expected ln Bayes factor at an amplitude [scales] in the heart at coordinates (b,); NaN without a beat."""
        x = np.concatenate([heart, [amplitude], np.zeros(len(candidate.unknowns) - 1)])
        baseline, single = hypothesis(self.model), hypothesis(self.model, (candidate,))
        expected = expected_log_bayes_factor(baseline, single, self.blocks, x)
        return np.nan if expected is None else expected


def _select(library: Mapping[str, Candidate], names: Sequence[str]) -> dict[str, Candidate]:
    return {name: candidate for name, candidate in library.items() if not names or name in names}


def _sample_recording(nominal: NominalHeart, curves: Sequence[str]) -> Recording:
    """The nominal heart's beat, sampled as a study samples frames and catheters."""
    beat, period = nominal.beat(NUMERICS), nominal.heart.period
    frames, samples = np.arange(FRAMES) * period / FRAMES, np.arange(int(period * RATE)) / RATE
    times = {name: frames if name.endswith("_volume") else samples for name in curves}
    values = {name: np.interp(at, beat.time, beat.signals()[name]) for name, at in times.items()}
    recording = Recording(period, {name: Samples(times[name], values[name]) for name in curves})
    return recording if nominal.right is None else recording.with_both_ventricles()


RECORD_PRESSURE = "the left ventricular pressure over a beat: the volume alone shows one in nine effects"


@dataclass(frozen=True)
class Option:
    """A measurement: description, cost, factors on parameters of the heart, and further curves."""

    name: str
    cost: float
    load: Mapping[str, float] = field(default_factory=dict)
    curves: tuple[str, ...] = ()


OPTIONS = (
    Option("the flow through the mitral valve", 1.0, curves=("mitral_flow",)),
    Option("the flow through the aortic valve", 1.0, curves=("aortic_flow",)),
    Option(
        "the same curves with the legs raised",
        2.0,
        {"circulation.left_atrium": 1.3, "circulation.right_atrium": 1.3},
    ),
    Option("the same curves while a hand is squeezed", 2.0, {"circulation.systemic.R_p": 1.25}),
    Option("the pressure of the aorta", 3.0, curves=("aorta_pressure",)),
)
"""Possible measurements; costs in echocardiograms."""
NOISES = {
    "flow": Noise((30e-6,), 0.02, 15e-6, 60e-6),
    "pressure": Noise((100.0,), 0.0, 200.0, 500.0, 0.1),
}
"""Noise of Doppler or phase contrast [m^3/s], and of a catheter [Pa]."""
TIMES = 40


def next_measurement(
    nominal: NominalHeart, data: Data, library: Mapping[str, Candidate], explanations: Sequence[Explanation]
) -> str:
    """Sentence about the cheapest option that is expected to decide between the explanations; else the best one."""
    options = [_measurement(option, nominal, data, library) for option in OPTIONS]
    prospects = plan(explanations, options)
    return _sentence(prospects[0]) if prospects else ""


def _sentence(best: Prospect) -> str:
    expected = f"the simulation expects a ln Bayes factor of {best.gain:.1f}"
    return f"{best.name}: {expected}" + (
        "" if best.gain >= DECISIVE else f", below {DECISIVE:g}: no measurement tried decides"
    )


def _measurement(
    option: Option, nominal: NominalHeart, data: Data, library: Mapping[str, Candidate]
) -> FurtherMeasurement:
    changed = {path: factor * nominal.values[path] for path, factor in option.load.items()}
    loaded = replace(nominal, heart=nominal.heart.with_parameters(changed))
    period = nominal.heart.period
    recorded = tuple(block for block in data.blocks if block.curve != BALANCE)
    blocks = tuple(_block(name, period) for name in option.curves) or recorded

    def forward(effects: tuple[str, ...]) -> Callable[[Floats], Floats | None]:
        model = SphereForwardModel.at_samples(loaded, blocks)
        return hypothesis(model, tuple(library[name] for name in effects)).forward

    return FurtherMeasurement(option.name, option.cost, blocks, forward)


def _block(name: str, period: float) -> Block:
    kind = name.rsplit("_", 1)[1]
    unit = "m^3/s" if kind == "flow" else "Pa"
    return Block(name, unit, np.arange(TIMES) * period / TIMES, period, NOISES[kind])

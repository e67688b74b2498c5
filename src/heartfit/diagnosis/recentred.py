r"""The sphere centred on a beat of the three-dimensional model.

A sphere differs from ventricles in structure, and what that leaves looks like a damped catheter or a stiff pericardium.
Fitted once to the beat at the prior's mean, without noise and with everything free, it follows the beats of that
model's other parameters as well, and the search looks for what both of them lack. A beat it cannot follow is refused.

Free beside what the search leaves free are the volume of the wall and some constants of the law, which stay as found.
"""

from collections.abc import Collection, Mapping
from dataclasses import replace
from math import exp

import numpy as np

from heartfit.diagnosis.centre import HUMAN, Centre
from heartfit.diagnosis.free import moved
from heartfit.diagnosis.library import BASE, hypothesis
from heartfit.diagnosis.recording import Recording, Samples
from heartfit.diagnosis.twin import Twin
from heartfit.discovery.bench import Bench
from heartfit.discovery.data import Block, Data, Noise
from heartfit.discovery.hypothesis import Coordinate, Hypothesis
from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.heart import Heart
from heartfit.observation.curve import Curve
from heartfit.sphere.heart import Inertia

FOLLOWED = {"lv_volume": 0.7e-6, "lv_pressure": 100.0}
"""Root mean square error, m^3 and Pa, beyond which the sphere does not follow the beat."""
WALL = 0.3
CONSTANTS = {"c_2": 0.5, "E_s": 0.5}
"""Standard deviations of the logarithms."""
SOFTER = 0.6
"""Contractility of a sphere over that of a mesh: all its fibres pull in its plane."""
SAMPLES, ROUNDS = 60, 3


def recentred(heart: Heart, beat: Mapping[str, Curve], recorded: Collection[str] = tuple(FOLLOWED)) -> Centre:
    """The centre fitted to the "lv_volume" and "lv_pressure" of a beat of the heart, time zero at its trigger.

    Raises InputError where the sphere does not follow what is ``recorded``.
    """
    curves = {name: beat[name].resampled(SAMPLES) for name in FOLLOWED}
    samples = {name: Samples(curve.times, curve.values) for name, curve in curves.items()}
    recording = Recording(heart.period, samples)
    data, centre = _data(recording), _start(heart, recording)
    for _ in range(ROUNDS):  # each begins where the one before ended, so that no prior holds it back
        centre, predicted = _fitted(centre, data)
    for block, rows in zip(data.blocks, data.rows, strict=True):
        if block.curve in recorded:
            _require_followed(block.curve, (predicted - data.values)[rows])
    return centre


def _start(heart: Heart, recording: Recording) -> Centre:
    """The heart itself as a sphere of an adult's proportions."""
    ratio = recording.end_diastolic_volume() / HUMAN.filled
    weaker = heart.with_parameters({"sigma_0": SOFTER * heart.tissue.active.sigma_0})
    return Centre(weaker, ratio * HUMAN.cavity, ratio * HUMAN.wall, ratio * HUMAN.filled, Inertia())


def _data(recording: Recording) -> Data:
    blocks = tuple(
        Block(name, "SI", samples.times, recording.period, Noise((0.5 * FOLLOWED[name],), 0.0, 0.0, 0.0))
        for name, samples in recording.curves.items()
    )
    return Data(np.concatenate([samples.values for samples in recording.curves.values()]), blocks)


def _fitted(centre: Centre, data: Data) -> tuple[Centre, Floats]:
    times = {block.curve: block.times for block in data.blocks}
    count = len(BASE)

    def forward(x: Floats) -> Floats | None:
        return hypothesis(Twin(_with_constants(centre, x[count:]), times)).forward(x[:count])

    more = tuple(Coordinate(name) for name in ("wall", *CONSTANTS))
    every = Hypothesis((), BASE + more, forward)
    found = Bench(data).explain(every, every.at(0.0))
    if found is None:
        raise InputError("centre: the sphere does not beat about the three-dimensional heart's parameters")
    x = found.fit.x
    return moved(_with_constants(centre, x[count:]), x[:count]), found.fit.predicted


def _with_constants(centre: Centre, x: Floats) -> Centre:
    values = centre.heart.parameters()
    pairs = zip(CONSTANTS.items(), x[1:].tolist(), strict=True)
    changed = {name: values[centre.heart.path_of(name)] * exp(sd * z) for (name, sd), z in pairs}
    wall = centre.wall * exp(WALL * float(x[0]))
    return replace(centre, heart=centre.heart.with_parameters(changed), wall=wall)


def _require_followed(curve: str, error: Floats) -> None:
    left = float(np.sqrt(np.mean(error**2)))
    if left > FOLLOWED[curve]:
        raise InputError(
            f"centre: the sphere leaves {left:.3g} of the beat's {curve} (root mean square, SI); expected at most "
            f"{FOLLOWED[curve]:g}: it stands for another heart than this one"
        )

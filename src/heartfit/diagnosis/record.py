r"""A recording as data of the search: what is averaged, and how noisy each curve may be.

A catheter's samples are averaged over 10 ms of the phase, over all beats. The noise level of either curve is unknown:
it is one of some levels, equally likely. Volumes err by 1 to 3 % of the end-diastolic volume, neighbours alike;
a catheter's samples by 0.3 kPa each. Roughness and discrepancy are what any model, and a wrong one, leaves over.
"""

import numpy as np

from heartfit.diagnosis.recording import Recording, Samples
from heartfit.discovery.data import Block, Data, Noise
from heartfit.geometry.arrays import Floats

BIN = 0.010
"""s of pressure that are averaged."""
ROUNDING = 1e-6
"""Of times, over the bin: a sample on the edge belongs to the later bin."""
VOLUME_LEVELS, VOLUME_MEMORY = (0.008, 0.0133, 0.02, 0.028), 0.065
"""Of a frame over the end-diastolic volume; s."""
PRESSURE_LEVELS = (50.0, 100.0, 200.0)
"""Of a mean over 10 ms of one beat, Pa."""
VOLUME_ROUGHNESS, PRESSURE_ROUGHNESS, ROUGHNESS_MEMORY = 0.004, 200.0, 0.1
"""Over the end-diastolic volume, Pa, and s: on 12 hearts without an effect, of another model, the evidence of none is
e^2 times that with 150 Pa and 50 ms, and the largest ln Bayes factor of an unknown effect falls from 7.4 to 3.9."""
VOLUME_DISCREPANCY, PRESSURE_DISCREPANCY = 0.017, 500.0
"""Likewise, of a model that is wrong."""


def data_of(recording: Recording) -> Data:
    """What the search compares: the curves that a left ventricle explains, one block each."""
    kept = {name: _averaged(recording, name) for name in recording.searched}
    blocks = tuple(_block(recording, name, samples.times) for name, samples in kept.items())
    return Data(np.concatenate([samples.values for samples in kept.values()]), blocks)


def _averaged(recording: Recording, name: str) -> Samples:
    samples = recording.curves[name]
    if name == "lv_volume" or not _dense(samples, recording.period):
        return samples
    phases = np.mod(samples.times, recording.period)
    places = np.floor(phases / BIN + ROUNDING).astype(int)
    counts = np.bincount(places)
    held = counts > 0
    times, values = (np.bincount(places, each)[held] / counts[held] for each in (phases, samples.values))
    return Samples(times, values)


def _dense(samples: Samples, period: float) -> bool:
    """Whether averaging leaves fewer numbers: samples nearer than the bins, or several beats of them."""
    return samples.times.size > period / BIN + 1


def _block(recording: Recording, name: str, times: Floats) -> Block:
    if name == "lv_volume":
        size = recording.end_diastolic_volume()
        levels = tuple(size * level for level in VOLUME_LEVELS)
        noise = Noise(levels, VOLUME_MEMORY, size * VOLUME_ROUGHNESS, size * VOLUME_DISCREPANCY)
        return Block(name, "m^3", times, recording.period, noise)
    beats = max(1.0, np.ptp(recording.curves[name].times) / recording.period)
    levels = tuple(level / np.sqrt(beats) for level in PRESSURE_LEVELS)
    noise = Noise(levels, 0.0, PRESSURE_ROUGHNESS, PRESSURE_DISCREPANCY, ROUGHNESS_MEMORY)
    return Block(name, "Pa", times, recording.period, noise)

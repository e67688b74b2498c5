r"""Whether a centred sphere invents effects in beats of the very model on which it was centred.

Nothing is hidden in the beats of sigma points, which a calibration has anyway. As they would be recorded, with noise of
the middle level and at the times of the recording, they are searched:

.. math:: b = \mathrm{median}_i \max_m \ln B_m(y_i) ,

every mechanism m fitted once from where the model without one ended. The number of alarms tells a good centre from a
bad one less well: it changes late.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from heartfit.diagnosis.centre import Centre
from heartfit.diagnosis.library import BASE, candidates, hypothesis
from heartfit.diagnosis.record import data_of
from heartfit.diagnosis.recording import Recording
from heartfit.diagnosis.twin import Twin
from heartfit.discovery.bench import Bench
from heartfit.discovery.data import Block, Data
from heartfit.discovery.survey import from_none
from heartfit.geometry.arrays import Floats
from heartfit.observation.curve import Curve

LARGEST = 1.5
"""ln Bayes factor beyond which the differences of structure pass for effects."""


def self_test(recording: Recording, centre: Centre, beats: Sequence[Mapping[str, Curve]]) -> float:
    """The median of the largest ln Bayes factors in beats without an effect, time zero at their triggers."""
    like, random = data_of(recording), np.random.default_rng(0)
    return float(np.median([largest(recorded(like, beat, random), centre) for beat in beats]))


def recorded(like: Data, beat: Mapping[str, Curve], random: np.random.Generator) -> Data:
    """A beat as other data were recorded, with the noise of the instrument and nothing else."""
    values = [beat[block.curve](block.times) + _noise(block, random) for block in like.blocks]
    return Data(np.concatenate(values), like.blocks)


def _noise(block: Block, random: np.random.Generator) -> Floats:
    roughness = block.noise.covariance(block.times, block.period, 0.0)
    instrument = block.noise.covariance(block.times, block.period, block.noise.middle) - roughness
    noise: Floats = np.linalg.cholesky(instrument) @ random.standard_normal(block.times.size)
    return noise


def largest(data: Data, centre: Centre) -> float:
    """The largest ln Bayes factor of any mechanism over none; infinite where the sphere does not beat."""
    twin, bench = Twin(centre, {block.curve: block.times for block in data.blocks}), Bench(data)
    none = bench.explain(hypothesis(twin), np.zeros(len(BASE)))
    if none is None:
        return np.inf
    found = [from_none(bench, none, hypothesis(twin, (each,))) for each in candidates(twin).values()]
    return max(each.log_evidence for each in found if each is not None) - none.log_evidence

r"""How far a right model may lie from fitted samples.

.. math:: R = R_{measurement} + \rho^2 e^{-|t_i - t_j| / \tau}

The first is the noise model of the images, or without one what the upper half of each curve's own spectrum holds; the
second the roughness of any model.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.observation.curve import Curve
from heartfit.observation.noise import frame_noise
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.residual import ROUGHNESS
from heartfit.proof.split import Sampled

MEMORY = 0.05
"""Of the roughness, s."""


def covariance(fitted: Sampled, measured: Mapping[str, Curve], models: Sequence[NoiseModel]) -> Floats:
    """R (n, n), in the order of the samples; measured: the curves they are of."""
    blocks = [_block(name, samples.times, measured[name], models) for name, samples in fitted.items()]
    ends = np.cumsum([0, *(len(block) for block in blocks)])
    total = np.zeros((ends[-1], ends[-1]))
    for start, end, block in zip(ends[:-1], ends[1:], blocks, strict=True):
        total[start:end, start:end] = block
    return total


def _block(name: str, times: Floats, curve: Curve, models: Sequence[NoiseModel]) -> Floats:
    kind = name.rsplit("_", 1)[1]
    apart = np.abs(times[:, None] - times)
    rough: Floats = ROUGHNESS[kind] ** 2 * np.exp(-np.minimum(apart, curve.period - apart) / MEMORY)
    for model in models if kind == "volume" else ():
        phases = np.rint(times / curve.period * len(model.curve.names)).astype(int)
        return rough + model.curve_covariance(curve)[np.ix_(phases, phases)]
    return rough + frame_noise(curve) ** 2 * np.eye(times.size)

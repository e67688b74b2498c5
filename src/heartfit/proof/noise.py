r"""How far a right model may lie from fitted samples.

.. math:: R = R_{measurement} + \rho^2 e^{-|t_i - t_j| / \tau} + \sum_j s^2 g_j g_j^T, \qquad
          g_j = \frac{\partial y}{\partial \ln p_j}

The first is the noise model of the images, or without one what the upper half of each curve's own spectrum holds; the
second the roughness of any model; the last what parameters do that the refit holds fixed though they scatter by s. Held
without it, they would make an effect of their own error.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.calibration.unscented import SigmaPoint
from heartfit.geometry.arrays import Floats
from heartfit.observation.curve import Curve
from heartfit.observation.noise import frame_noise
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.residual import ROUGHNESS
from heartfit.proof.split import Sampled

MEMORY = 0.05
"""Of the roughness, s."""


@dataclass(frozen=True, eq=False)
class Around:
    """Points about the prior's mean, two for each parameter, and the curves of their beats by the points' labels."""

    points: Sequence[SigmaPoint]
    curves: Mapping[str, Mapping[str, Curve]]


def covariance(fitted: Sampled, measured: Mapping[str, Curve], models: Sequence[NoiseModel]) -> Floats:
    """The first two terms of R (n, n), in the order of the samples; measured: the curves they are of."""
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


def held_fixed(
    estimated: Sequence[str], around: Around, fitted: Sampled, measured: Mapping[str, Curve], sd: float
) -> Floats:
    """The last term (n, n): the slopes of another heart at the same phases, over the range of its curve and this one's.

    A parameter of whose two beats one failed is left out.
    """
    steps = {point.label: float(point.z.sum()) for point in around.points}
    total = np.zeros((sum(each.times.size for each in fitted.values()),) * 2)
    for name in (label[:-1] for label in steps if label.endswith("+")):
        up, down = around.curves[f"{name}+"], around.curves[f"{name}-"]
        if name not in estimated and up and down:
            apart = steps[f"{name}+"] - steps[f"{name}-"]
            moved = [_moved(up[key], down[key], each.times, measured[key]) for key, each in fitted.items()]
            slope = np.concatenate(moved) * sd / apart
            total += np.outer(slope, slope)
    return total


def _moved(up: Curve, down: Curve, times: Floats, measured: Curve) -> Floats:
    """The difference (k,) of two beats, on the scale and at the phases of a measured curve."""
    phases = times / measured.period * up.period
    return (up(phases) - down(phases)) * np.ptp(measured.values) / np.ptp(0.5 * (up.values + down.values))

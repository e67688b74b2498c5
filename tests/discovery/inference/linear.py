"""Linear hypotheses with closed-form results."""

import numpy as np

from heartfit.discovery.inference.data import Block, Data, Noise
from heartfit.discovery.inference.hypothesis import Coordinate, Hypothesis

TIMES = np.arange(8) / 8
NOISE = Noise((0.3, 0.6), 0.1, 0.1, discrepancy=0.5)


def slopes(d: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).standard_normal((TIMES.size, d))


def hypothesis(matrix: np.ndarray, *amplitudes: Coordinate) -> Hypothesis:
    """Base coordinates and, for the last columns, amplitudes."""
    base = matrix.shape[1] - len(amplitudes)
    coordinates = (*(Coordinate(f"z{index}") for index in range(base)), *amplitudes)
    return Hypothesis(tuple(amplitude.name for amplitude in amplitudes), coordinates, lambda x: matrix @ x)


def data(values: np.ndarray, noise: Noise = NOISE) -> Data:
    return Data(values, (Block("y", "m", TIMES, 1.0, noise),))


def covariances(noise: Noise = NOISE) -> list[np.ndarray]:
    return [noise.covariance(TIMES, 1.0, level) for level in noise.levels]

"""A damped oscillator, nonlinear and fast, whose two curves may hide one of five effects.

    x(t) = A e^(-z w t) cos(w (t - t_0)) + b,   v = dx / dt,   t in [0, 1)

The base coordinates scale A, w and z and shift b; standard deviations as in ``SPREAD``.
"""

import numpy as np

from heartfit.discovery.inference.data import Block, Data, Noise
from heartfit.discovery.inference.hypothesis import Coordinate, Hypothesis

TIMES = np.arange(24) / 24
SPREAD = {"amplitude": 0.2, "frequency": 0.1, "damping": 0.3, "offset": 0.1}
BASE = tuple(Coordinate(name) for name in SPREAD)
POSITION = Noise((0.02, 0.04), 0.05, 0.01, discrepancy=0.2)
SPEED = Noise((0.3,), 0.0, 0.1, discrepancy=1.5)
BLOCKS = (Block("position", "m", TIMES, 1.0, POSITION), Block("speed", "m/s", TIMES, 1.0, SPEED))


def curves(base: np.ndarray, delay: float = 0.0, drift: float = 0.0, pulse: float = 0.0) -> np.ndarray:
    size, frequency = np.exp(0.2 * base[0]), 9.0 * np.exp(0.1 * base[1])
    decay, t = 2.0 * np.exp(0.3 * base[2]), TIMES - 0.02 * delay
    wave = size * np.exp((1j * frequency - decay) * t)
    bump = 0.15 * pulse * np.exp(-0.5 * ((TIMES - 0.6) / 0.05) ** 2)
    position = wave.real + 0.1 * base[3] + 0.1 * drift * TIMES**2 + bump
    speed = ((1j * frequency - decay) * wave).real + 0.2 * drift * TIMES - bump * (TIMES - 0.6) / 0.05**2
    return np.concatenate([position, speed])


def with_clipping(base: np.ndarray, clipped: float) -> np.ndarray:
    traces = curves(base)
    traces[:24] = np.tanh(clipped * 0.4 * traces[:24]) / (clipped * 0.4) if clipped > 1e-9 else traces[:24]
    return traces


def with_gain(base: np.ndarray, gain: float) -> np.ndarray:
    traces = curves(base)
    traces[24:] *= np.exp(0.1 * gain)
    return traces


EFFECTS = {
    "clipping": (True, with_clipping),
    "delay": (False, lambda base, a: curves(base, delay=a)),
    "drift": (False, lambda base, a: curves(base, drift=a)),
    "gain": (False, with_gain),
    "pulse": (True, lambda base, a: curves(base, pulse=a)),
}
NONE = Hypothesis((), BASE, curves)


def single(name: str) -> Hypothesis:
    one_sided, forward = EFFECTS[name]
    coordinates = (*BASE, Coordinate(name, one_sided, amplitude=True))
    return Hypothesis((name,), coordinates, lambda x: forward(x[:4], x[4]))


def combined(names: tuple[str, str]) -> Hypothesis:
    """Sum of the changes of each effect."""
    first, second = (EFFECTS[name] for name in names)
    extra = [Coordinate(name, EFFECTS[name][0], amplitude=True) for name in names]

    def both(x: np.ndarray) -> np.ndarray:
        return first[1](x[:4], x[4]) + second[1](x[:4], x[5]) - curves(x[:4])

    return Hypothesis(names, (*BASE, *extra), both)


SINGLES = [single(name) for name in EFFECTS]


def noise(random: np.random.Generator) -> np.ndarray:
    position = POSITION.covariance(TIMES, 1.0, random.choice(POSITION.levels))
    speed = SPEED.covariance(TIMES, 1.0, SPEED.levels[0])
    return np.concatenate(
        [random.multivariate_normal(np.zeros(24), covariance) for covariance in (position, speed)]
    )


def observed(truth: np.ndarray, seed: int) -> Data:
    return Data(truth + noise(np.random.default_rng(seed)), BLOCKS)

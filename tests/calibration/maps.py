"""Maps of known posterior, as forward models."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import Forward, Outcome

NAMES = ("V_min", "q_max", "q_min")
NOISE = np.diag([0.01, 0.02, 0.005])


def random_prior(n: int, seed: int) -> Gaussian:
    random = np.random.default_rng(seed)
    root = random.standard_normal((n, n)) + 2 * np.eye(n)
    return Gaussian(tuple(f"p{i}" for i in range(n)), random.standard_normal(n), 0.04 * root @ root.T)


def forward_of(prior: Gaussian, function: Callable[[np.ndarray], np.ndarray]) -> Forward:
    """From parameters by name to the function of their logarithms."""

    def forward(parameters: Sequence[Mapping[str, float]]) -> list[Outcome]:
        z = [np.log([point[name] for name in prior.names]) for point in parameters]
        return [dict(zip(NAMES, function(point).tolist(), strict=True)) for point in z]

    return forward


def failing(forward: Forward, lost: Sequence[int]) -> Forward:
    """The same model whose runs of these numbers, counted from 0, fail."""
    calls = [0]

    def failed(parameters: Sequence[Mapping[str, float]]) -> list[Outcome]:
        outcomes = [
            "no beat" if calls[0] + index in lost else outcome
            for index, outcome in enumerate(forward(parameters))
        ]
        calls[0] += len(outcomes)
        return outcomes

    return failed


def slopes(n: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).standard_normal((len(NAMES), n))


def named(z: np.ndarray) -> dict[str, float]:
    return dict(zip(NAMES, z.tolist(), strict=True))


def kalman(prior: Gaussian, a: np.ndarray, observed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mean and covariance after observing z = A x with NOISE."""
    weight = np.linalg.inv(NOISE)
    covariance = np.linalg.inv(np.linalg.inv(prior.covariance) + a.T @ weight @ a)
    return prior.mean + covariance @ a.T @ weight @ (observed - a @ prior.mean), covariance

"""Gains and an error of known size are recovered from sequences; the covariance is that of the drawn curves."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.observation.gain_noise import (
    MEMORY_BOUNDS,
    GainNoise,
    Pattern,
    TrackedCurves,
    patterns_of,
    unit_covariance,
)

TIMES = 0.036 * np.arange(25)
KNOWN = GainNoise(
    gain=0.9, common_sd=0.08, element_sd=0.15, sd=0.01, memory=0.1, shared=0.2, sequences=400, pattern="mean"
)


def true_curves(rng: np.random.Generator, curves: int = 16) -> np.ndarray:
    """Contraction of any size and time in each curve, zero in phase 0."""
    size = -0.15 * np.exp(0.3 * rng.standard_normal((curves, 1)))
    end = 0.3 + 0.03 * rng.standard_normal((curves, 1))
    pulse = np.exp(-0.5 * ((TIMES - end) / 0.12) ** 2)
    return size * (pulse - pulse[:, :1])


def draw(noise: GainNoise, rng: np.random.Generator, true: np.ndarray) -> np.ndarray:
    """Registered curves as the model draws them: gains, and an error of which phase 0 is the reference."""
    common = noise.common_sd * rng.standard_normal()
    elements = noise.element_sd * rng.standard_normal((len(true), 1))
    lags = np.abs(TIMES[:, None] - TIMES)
    root = np.linalg.cholesky(np.exp(-lags / noise.memory) + 1e-12 * np.eye(TIMES.size))
    own_error, common_error = rng.standard_normal(true.shape), rng.standard_normal(TIMES.size)
    mixed = np.sqrt(1.0 - noise.shared) * own_error + np.sqrt(noise.shared) * common_error
    error = noise.sd * mixed @ root.T
    own = (noise.gain + common) * true
    return own + elements * patterns_of(true, noise.pattern) + error - error[:, :1]


def sequences(noise: GainNoise, count: int, seed: int, curves: int = 16) -> list[TrackedCurves]:
    rng = np.random.default_rng(seed)
    trues = [true_curves(rng, curves) for _ in range(count)]
    return [TrackedCurves(true, draw(noise, rng, true), TIMES) for true in trues]


@pytest.mark.parametrize("pattern", ["own", "mean"])
def test_gains_and_error_are_recovered_from_many_sequences(pattern: Pattern) -> None:
    known = GainNoise(**{**vars(KNOWN), "pattern": pattern})
    estimated = GainNoise.from_sequences(sequences(known, 400, seed=1), pattern)
    assert estimated.gain == pytest.approx(0.9, abs=3.0 * 0.09 / 20.0)
    assert estimated.common_sd == pytest.approx(0.08, rel=0.15)
    assert estimated.element_sd == pytest.approx(0.15, rel=0.1)
    assert estimated.sd == pytest.approx(0.01, rel=0.05)
    assert estimated.memory == pytest.approx(0.1, rel=0.1)
    assert estimated.shared == pytest.approx(0.2, abs=0.03)
    assert estimated.sequences == 400


def test_a_single_curve_has_a_common_gain_alone() -> None:
    known = GainNoise(0.95, 0.1, 0.0, 0.01, 0.05, 0.0, 400)
    estimated = GainNoise.from_sequences(sequences(known, 400, seed=2, curves=1))
    assert estimated.gain == pytest.approx(0.95, abs=0.02)
    assert estimated.common_sd == pytest.approx(0.1, rel=0.15)
    assert estimated.element_sd == 0.0
    assert estimated.sd == pytest.approx(0.01, rel=0.1)
    assert estimated.memory == pytest.approx(0.05, rel=0.25)


def test_no_gain_error_is_estimated_as_next_to_none() -> None:
    known = GainNoise(1.0, 0.0, 0.0, 0.01, 0.1, 0.0, 100)
    estimated = GainNoise.from_sequences(sequences(known, 100, seed=3))
    assert estimated.common_sd < 0.02
    assert estimated.element_sd < 0.03
    assert estimated.shared < 0.03


def test_an_error_without_memory_has_the_shortest_one() -> None:
    known = GainNoise(1.0, 0.0, 0.0, 0.01, 1e-4, 0.0, 50)
    assert GainNoise.from_sequences(sequences(known, 50, seed=4)).memory <= 10.0 * MEMORY_BOUNDS[0]


@pytest.mark.parametrize("pattern", ["own", "mean"])
def test_the_covariance_is_that_of_drawn_curves(pattern: Pattern) -> None:
    known = GainNoise(**{**vars(KNOWN), "pattern": pattern})
    rng = np.random.default_rng(5)
    true = true_curves(rng, 3)
    drawn = np.array([draw(known, rng, true).ravel() for _ in range(20000)])
    expected = known.covariance(true, TIMES)
    assert drawn.mean(axis=0) == pytest.approx(0.9 * true.ravel(), abs=1e-3)
    scale = np.sqrt(np.outer(np.diag(expected), np.diag(expected))).max()
    assert np.cov(drawn, rowvar=False) == pytest.approx(expected, abs=0.05 * scale)


def test_phase_0_has_no_variance_and_the_rest_is_positive_definite() -> None:
    true = true_curves(np.random.default_rng(6))
    covariance = KNOWN.covariance(true, TIMES).reshape(16, 25, 16, 25)
    assert not covariance[:, 0].any()
    assert not covariance[:, :, :, 0].any()
    later = covariance[:, 1:, :, 1:].reshape(16 * 24, -1)
    assert np.linalg.eigvalsh(later).min() > 0.0
    assert later == pytest.approx(later.T)


def test_late_phases_have_twice_the_variance_of_the_error() -> None:
    assert np.diag(unit_covariance(np.array([0.0, 0.1, 10.0]), 0.1)) == pytest.approx(
        [0.0, 2.0 * (1.0 - np.exp(-1.0)), 2.0]
    )


def test_an_element_without_motion_keeps_the_error_of_the_mean() -> None:
    true = true_curves(np.random.default_rng(7), 4)
    true[0] = 0.0
    noise = GainNoise(1.0, 0.0, 0.2, 1e-6, 0.1, 0.0, 2, "mean")
    sd = np.sqrt(np.diag(noise.covariance(true, TIMES))[:25])
    assert sd == pytest.approx(0.2 * np.abs(true.mean(axis=0)), abs=1e-5)
    own = GainNoise(1.0, 0.0, 0.2, 1e-6, 0.1, 0.0, 2, "own")
    assert np.sqrt(np.diag(own.covariance(true, TIMES))[:25]) == pytest.approx(np.zeros(25), abs=1e-5)


def test_one_sequence_teaches_nothing() -> None:
    with pytest.raises(InputError, match="1 sequences"):
        GainNoise.from_sequences(sequences(KNOWN, 1, seed=8))


def test_curves_of_other_shapes_and_without_motion_are_refused() -> None:
    true = true_curves(np.random.default_rng(9))
    with pytest.raises(InputError, match="one for each curve and time"):
        TrackedCurves(true, true[:, :-1], TIMES)
    with pytest.raises(InputError, match="true curves are zero"):
        TrackedCurves(0.0 * true, true, TIMES)

"""The structural discrepancy: phases between landmarks, and its covariance."""

import numpy as np
import pytest

from heartfit.discovery.inference.data import Block, Noise
from heartfit.discovery.sphere_model.landmarks import FALL, PHASES, Frame, Landmarks
from heartfit.discovery.sphere_model.structure import SHRINKAGE, Structure

PERIOD = 0.8
MARKS = Landmarks(0.1, 0.4, PERIOD)
FRAME = Frame(MARKS, {"lv_volume": 150e-6, "lv_pressure": 16e3})
NOISE = Noise((1.0,), 0.0, 0.0, 0.0)


def block(curve: str, times: np.ndarray) -> Block:
    return Block(curve, "SI", times, PERIOD, NOISE)


BLOCKS = (
    block("lv_volume", np.arange(28) * PERIOD / 28),
    block("lv_pressure", (np.arange(80) + 0.5) * PERIOD / 80),
)
RESIDUALS = np.random.default_rng(2).standard_normal((7, 2 * PHASES))


def test_landmarks_are_the_half_rise_and_half_fall() -> None:
    times = np.arange(100) * PERIOD / 100
    pressure = np.where((times >= 0.7) | (times < 0.3), 16e3, 1e3)
    marks = Landmarks.from_pressure(times, pressure, PERIOD)
    assert marks.rise == pytest.approx(0.7, abs=0.01), "a systole that goes over the trigger"
    assert marks.fall == pytest.approx(0.3, abs=0.01)


def test_phases_run_evenly_between_the_landmarks() -> None:
    phases = MARKS.phases(np.array([0.1, 0.25, 0.4, 0.65, 0.05 + PERIOD]))
    assert phases == pytest.approx([0.0, 0.5 * FALL, FALL, 0.5 * (1.0 + FALL), FALL + 0.6 * 0.45 / 0.5])


def test_a_residual_over_the_phases_returns_to_the_samples() -> None:
    """A smooth residual of 1 % of the unit; piecewise linear interpolation on 100 phases."""
    parts = [
        0.01 * FRAME.units[part.curve] * np.sin(2.0 * np.pi * MARKS.phases(part.times)) for part in BLOCKS
    ]
    there = FRAME.residual(BLOCKS, parts)
    back = FRAME.weights(BLOCKS) @ there
    assert back == pytest.approx(np.concatenate(parts), abs=0.02 * 0.01 * 16e3, rel=0.02)
    assert there[:PHASES] == pytest.approx(0.01 * np.sin(2.0 * np.pi * np.arange(PHASES) / PHASES), abs=3e-4)


def test_of_a_curve_that_no_residual_has_nothing_is_learnt() -> None:
    aorta = block("aorta_pressure", np.arange(10) * 0.08)
    assert not FRAME.weights((aorta,)).any()


def test_the_covariance_keeps_the_variances_and_shrinks_all_else() -> None:
    structure = Structure.from_residuals(RESIDUALS)
    empirical = RESIDUALS.T @ RESIDUALS / 7
    assert np.diag(structure.covariance) == pytest.approx(np.diag(empirical))
    across = structure.covariance[:PHASES, PHASES:]
    assert across == pytest.approx((1.0 - SHRINKAGE) * empirical[:PHASES, PHASES:])
    assert np.linalg.eigvalsh(structure.covariance).min() > -1e-12
    assert np.linalg.matrix_rank(structure.covariance) > 40, "of 7 hearts"

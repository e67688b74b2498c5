"""Virtual volunteers: drawn from their seed, seen through their scanner, unlike the calibrator's model."""

import numpy as np
import pytest

from heartfit.beat import Beat
from heartfit.circulation.valves import OrificeValve
from heartfit.cohort.generate import acquire
from heartfit.cohort.hidden_heart import draw_heart
from heartfit.heart import FOURTEEN, Heart

PERIOD, FRAMES = 0.8, 25
STANDARD = {"sigma_0": 200e3, "mu": 8e3}


@pytest.fixture
def beat() -> Beat:
    """A cloud of nodes that swells and shifts with the beat, sampled finely."""
    time = np.linspace(0.0, PERIOD, 801)
    cloud = 0.03 * np.random.default_rng(0).standard_normal((200, 3))
    phase = 2.0 * np.pi * time[:, None, None] / PERIOD
    positions = cloud * (1.0 + 0.2 * np.cos(phase)) + 0.01 * np.sin(phase)
    return Beat(time, {}, {}, {}, PERIOD, trigger=0.195, positions=positions)


def test_the_same_seed_draws_the_same_heart() -> None:
    first, second, other = (draw_heart(STANDARD, PERIOD, seed) for seed in (3, 3, 4))
    assert first == second
    assert first != other


def test_the_hidden_heart_is_another_model() -> None:
    heart, _ = draw_heart(STANDARD, PERIOD, 1)
    valves = [getattr(heart.circulation, name) for name in ("mitral", "aortic", "tricuspid", "pulmonary")]
    assert all(isinstance(valve, OrificeValve) for valve in valves)
    assert heart.tissue.active.starling.slope > 0.0 == Heart().tissue.active.starling.slope
    assert heart.trigger != Heart().trigger
    assert heart.period == PERIOD


def test_the_truth_is_the_heart_s_value_of_the_paper_s_parameters() -> None:
    heart, truth = draw_heart(STANDARD, PERIOD, 1)
    assert tuple(truth) == FOURTEEN
    assert heart.with_parameters(truth) == heart


def test_the_hidden_hearts_scatter_about_the_standard() -> None:
    drawn = np.log([draw_heart(STANDARD, PERIOD, seed)[1]["sigma_0"] / 200e3 for seed in range(150)])
    assert drawn.mean() == pytest.approx(0.0, abs=0.04)
    assert drawn.std() == pytest.approx(0.15, rel=0.2)


def test_a_clean_acquisition_is_the_beat_from_its_trigger(beat: Beat) -> None:
    motion = acquire(beat, FRAMES, 0.0, np.random.default_rng(0))
    assert motion.positions.shape == (FRAMES, 200, 3)
    assert motion.times == pytest.approx(np.arange(FRAMES) * PERIOD / FRAMES)
    for frame, time in enumerate(motion.times):
        sample = round(((time + beat.trigger) % PERIOD) / PERIOD * 800)
        assert motion.positions[frame] == pytest.approx(np.asarray(beat.positions)[sample], abs=1e-12)


def test_noise_is_as_large_as_asked(beat: Beat) -> None:
    """A shift of each frame along each axis, and a dilation that moves a node at the mean radius as much."""
    noise, shifts, dilations = 1e-3, [], []
    clean = acquire(beat, FRAMES, 0.0, np.random.default_rng(0)).positions
    around = clean - clean.mean(axis=1, keepdims=True)
    for seed in range(40):
        noisy = acquire(beat, FRAMES, noise, np.random.default_rng(seed)).positions
        shifts.append((noisy - clean).mean(axis=1))
        spread = noisy - noisy.mean(axis=1, keepdims=True)
        dilations.append((spread * around).sum(axis=(1, 2)) / (around**2).sum(axis=(1, 2)) - 1.0)
    radius = np.sqrt((around**2).sum(axis=2).mean())
    assert np.std(shifts) == pytest.approx(noise, rel=0.05)
    assert np.std(dilations) * radius == pytest.approx(noise, rel=0.08)

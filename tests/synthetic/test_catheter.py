"""A pressure record has the requested rate, noise and zero."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.heart.beat import Beat, failed_beat
from heartfit.observation.curve import Curve
from heartfit.synthetic.scanner import Catheter

PERIOD, TRIGGER = 0.83, 0.17


def wave(time: np.ndarray) -> np.ndarray:
    return 6e3 * (1.0 + np.cos(2.0 * np.pi * (time - 0.4) / PERIOD))


@pytest.fixture
def beat() -> Beat:
    time = np.linspace(0.0, PERIOD, 2001)
    return Beat(time, {}, {"lv": wave(time), "aorta": 0.0 * time}, {}, PERIOD, TRIGGER)


def test_an_ideal_catheter_samples_the_ventricle_from_the_trigger(beat: Beat) -> None:
    times, values, period = Catheter(rate=200.0, noise=0.0, offset=0.0).record(beat, 0)
    assert period == PERIOD
    assert times == pytest.approx(np.arange(166) / 200.0)
    assert values == pytest.approx(wave(times + TRIGGER), abs=0.05)


@pytest.mark.parametrize("rate", [100.0, 250.0, 1000.0, 12.0 / PERIOD])
def test_a_record_is_a_curve_of_one_period(beat: Beat, rate: float) -> None:
    curve = Curve.of_pressure(*Catheter(rate=rate).record(beat, 1))
    assert PERIOD - 1.0 / rate <= curve.times[-1] + 1e-9 < PERIOD


def test_the_seed_is_the_recording(beat: Beat) -> None:
    first, again, other = (Catheter().record(beat, seed)[1] for seed in (4, 4, 5))
    assert (first == again).all()
    assert (first != other).all()


def test_noise_is_white_and_the_zero_is_drawn_once_a_recording(beat: Beat) -> None:
    catheter, still = Catheter(rate=250.0, noise=120.0, offset=300.0), Catheter(250.0, 0.0, 0.0)
    true = still.record(beat, 0)[1]
    errors = np.array([catheter.record(beat, seed)[1] - true for seed in range(400)])
    zeros = errors.mean(axis=1)
    noise = errors - zeros[:, None]
    assert zeros.mean() == pytest.approx(0.0, abs=3.0 * 300.0 / np.sqrt(400))
    assert zeros.std() == pytest.approx(300.0, rel=0.1)
    assert noise.std() == pytest.approx(120.0, rel=0.01)
    neighbours = np.mean(noise[:, 1:] * noise[:, :-1]) / np.mean(noise**2)
    assert neighbours == pytest.approx(0.0, abs=0.02)


@pytest.mark.parametrize("wrong", [{"rate": 0.0}, {"noise": -1.0}, {"offset": -1.0}, {"rate": np.nan}])
def test_an_invalid_catheter_is_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(InputError, match=r"rate.*deviations"):
        Catheter(**wrong)


def test_a_failed_beat_has_no_pressure() -> None:
    with pytest.raises(InputError, match="torn"):
        Catheter().record(failed_beat("torn", PERIOD, TRIGGER, {}), 0)

"""One half of the samples chooses a name and is fitted; the other half, which judges, has no influence on it."""

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.discovery.refit.target import MeasuredCase, stack
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.observation.curve import Curve
from heartfit.observation.residual import SIMULATION_ROUGHNESS

PERIOD, FRAMES, BINS = 0.8, 24, 80
TIMES = {
    "lv_volume": np.arange(FRAMES) * PERIOD / FRAMES,
    "lv_pressure": (np.arange(BINS) + 0.5) * PERIOD / BINS,
}
HELD = {"lv_volume": np.arange(FRAMES) % 2 == 1, "lv_pressure": np.arange(BINS) // 4 % 2 == 1}
"""Every other frame of the volume, and every other 40 ms of the pressure, one sample in each bin of 10 ms."""


def case(error: float = 0.0, both: bool = True) -> MeasuredCase:
    """Measured curves of both ventricles; error: of the held-out samples, over their stroke or pulse."""
    phases = {name: 2.0 * np.pi * times / PERIOD for name, times in TIMES.items()}
    volume = 100e-6 + 40e-6 * (np.cos(phases["lv_volume"]) + error * HELD["lv_volume"])
    pressure = 8e3 - 7e3 * (np.cos(phases["lv_pressure"]) + error * HELD["lv_pressure"])
    curves = {
        "lv_volume": Curve(TIMES["lv_volume"], volume, PERIOD),
        "lv_pressure": Curve(TIMES["lv_pressure"], pressure, PERIOD),
        "rv_volume": Curve(TIMES["lv_volume"], 1.1 * volume, PERIOD),
    }
    measured = {name: curve for name, curve in curves.items() if both or name != "rv_volume"}
    return MeasuredCase.from_curves(measured, [])


def times_of(recording: Recording | None) -> dict[str, Floats]:
    assert recording is not None
    return {name: recording.curves[name].times for name in TIMES}


def test_the_target_of_a_refit_is_the_fitted_half_and_nothing_else() -> None:
    target = case(both=False).target
    assert set(target.samples) == set(TIMES)
    for name, samples in target.samples.items():
        assert samples.times == pytest.approx(TIMES[name][~HELD[name]])
    assert target.values().size == FRAMES // 2 + BINS // 2 == len(target.covariance)


def test_a_target_of_both_ventricles_has_half_of_the_right_volume_too() -> None:
    target = case().target
    assert target.samples["rv_volume"].times == pytest.approx(TIMES["lv_volume"][~HELD["lv_volume"]])


def test_the_complete_target_has_every_sample_of_the_fitted_curves_once() -> None:
    both = case(error=0.1, both=False)
    complete = both.complete_target
    assert {name: samples.times.tolist() for name, samples in complete.samples.items()} == {
        name: pytest.approx(times) for name, times in TIMES.items()
    }
    fitted = complete.rows_of(both.target.samples)
    assert complete.values()[fitted] == pytest.approx(both.target.values())
    assert complete.covariance[np.ix_(fitted, fitted)] == pytest.approx(both.target.covariance)
    assert complete.rows_of({}).sum() == 0


def test_one_half_chooses_a_name_and_the_other_judges_it() -> None:
    chosen, unseen = map(times_of, case().halves())
    for name, times in TIMES.items():
        assert chosen[name] == pytest.approx(times[~HELD[name]])
        assert unseen[name] == pytest.approx(times[HELD[name]])


@pytest.mark.parametrize("both", [False, True])
def test_held_out_samples_change_neither_the_choice_of_a_name_nor_the_target(both: bool) -> None:
    sound, spoilt = case(both=both), case(0.05, both)
    assert np.array_equal(sound.target.values(), spoilt.target.values())
    (chosen, unseen), (same, other) = sound.halves(), spoilt.halves()
    assert unseen is not None
    assert other is not None
    for name in TIMES:
        assert np.array_equal(chosen.curves[name].values, same.curves[name].values)
        assert not np.array_equal(unseen.curves[name].values, other.curves[name].values)
    held = (
        stack({name: half.values for name, half in measured.split.held.items()})
        for measured in (sound, spoilt)
    )
    assert np.abs(np.subtract(*held)).max() > 0.0


def test_held_out_frames_of_a_second_reading_change_neither_noise_nor_target() -> None:
    """A second reading that errs on the frames that judge, with a drift that another scale would take up."""
    rng, volume = np.random.default_rng(6), case().raw["lv_volume"]
    second = volume.values + 2e-6 * rng.standard_normal(FRAMES)
    spoilt = np.where(HELD["lv_volume"], 0.8 * second + 5e-6, second)
    sound, misread = (
        MeasuredCase.from_curves({"lv_volume": volume}, [], Curve(volume.times, values, PERIOD))
        for values in (second, spoilt)
    )
    assert misread.frames == sound.frames
    assert misread.target.values() == pytest.approx(sound.target.values())
    assert misread.target.covariance == pytest.approx(sound.target.covariance)
    assert misread.split.held["lv_volume"].values != pytest.approx(sound.split.held["lv_volume"].values)


def test_a_correct_model_is_expected_to_miss_the_target_by_its_roughness() -> None:
    """Noiseless curves of one harmonic: the covariance is that of the roughness, of memory 50 ms and periodic."""
    target = case(both=False).target
    rows = {"volume": slice(0, FRAMES // 2), "pressure": slice(FRAMES // 2, None)}
    for kind, (name, samples) in zip(rows, target.samples.items(), strict=True):
        lags = np.abs(np.subtract.outer(samples.times, samples.times))
        rough = SIMULATION_ROUGHNESS[kind] ** 2 * np.exp(-np.minimum(lags, PERIOD - lags) / 0.05)
        assert target.covariance[rows[kind], rows[kind]] == pytest.approx(rough, rel=1e-6), name
    assert not target.covariance[rows["volume"], rows["pressure"]].any()


def test_a_correct_model_misses_a_curve_that_was_read_twice_by_the_noise_of_its_readings_too() -> None:
    """Both readings have white errors of 2 mL, their mean of 2 / sqrt(2) mL."""
    rng, once = np.random.default_rng(2), case()
    volume, sd = once.raw["lv_volume"], 2e-6
    variances = []
    for _ in range(40):
        first, second = (
            Curve(volume.times, volume.values + sd * rng.standard_normal(FRAMES), PERIOD) for _ in range(2)
        )
        twice = MeasuredCase.from_curves({"lv_volume": first}, [], second)
        variances.append(np.diag(twice.target.covariance).mean())
    assert np.mean(variances) == pytest.approx(0.5 * sd**2 + SIMULATION_ROUGHNESS["volume"] ** 2, rel=0.1)

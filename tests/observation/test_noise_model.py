"""A planted distortion is found again, undone, and its intervals hold the truth as often as they say."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binomtest

from heartfit.errors import InputError
from heartfit.observation.coverage import Share, coverage
from heartfit.observation.curve import Curve
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.pair import Pair, Reading

NAMES = ("V_min", "q_max", "q_min")
BIAS = np.array([0.04, -0.2, -0.15])
SPREAD = np.array([[1.0, -0.5, -0.2], [-0.5, 9.0, 4.0], [-0.2, 4.0, 6.0]]) * 1e-3
FRAMES = 10
PROTOCOL = {"snr": 30.0, "slice_thickness": 0.008}


def planted_curve(rng: np.random.Generator) -> np.ndarray:
    """Error over the measured stroke volume (10,): none in phase 0, then 3 % and 2 % that go together."""
    wave = np.sin(np.pi * np.arange(FRAMES) / FRAMES)
    return wave * (0.03 + 0.02 * rng.standard_normal() + 0.005 * rng.standard_normal(FRAMES))


def pair(seed: int) -> Pair:
    """A beat of any size and its measurement, distorted in logarithms and in volume as planted."""
    rng = np.random.default_rng(seed)
    size, stroke = np.exp(0.2 * rng.standard_normal(2))
    true = dict(zip(NAMES, size * np.array([60e-6, 350e-6, -400e-6]), strict=True))
    factors = np.exp(rng.multivariate_normal(BIAS, SPREAD))
    measured = {name: value * factor for (name, value), factor in zip(true.items(), factors, strict=True)}
    times = 0.8 / FRAMES * np.arange(FRAMES)
    seen = (120.0 + 35.0 * stroke * np.cos(2.0 * np.pi * times / 0.8)) * 1e-6
    volume = {"lv_volume": Curve(times, seen - np.ptp(seen) * planted_curve(rng), 0.8)}
    return Pair(Reading(volume, true), Reading({"lv_volume": Curve(times, seen, 0.8)}, measured))


def model(sequences: int, first: int = 0) -> NoiseModel:
    return NoiseModel.of([pair(first + seed) for seed in range(sequences)], PROTOCOL, FRAMES)


def test_planted_bias_and_covariance_are_found_within_their_sampling_error() -> None:
    found = model(1000)
    variance = np.diag(SPREAD)
    assert (np.abs(found.observations.mean - BIAS) < 3.0 * np.sqrt(variance / 1000)).all()
    error = np.sqrt((SPREAD**2 + np.outer(variance, variance)) / 1000)
    assert (np.abs(found.observations.covariance - SPREAD) < 3.0 * error).all()
    wave = np.sin(np.pi * np.arange(FRAMES) / FRAMES)
    sd = wave * np.hypot(0.02, 0.005)
    assert (np.abs(found.curve.mean - 0.03 * wave) <= 3.0 * sd / np.sqrt(1000) + 1e-15).all()
    assert found.curve.sd == pytest.approx(sd, rel=3.0 / np.sqrt(2000), abs=1e-15)
    together = found.curve.covariance[3, 6] / (found.curve.sd[3] * found.curve.sd[6])
    assert together == pytest.approx(0.02**2 / (0.02**2 + 0.005**2), abs=0.01)


def test_what_is_known_of_the_error_is_taken_off_exactly() -> None:
    """Sequences that all err alike: the corrected observations and curve are the truth, whatever its size."""
    factor, share = np.exp(BIAS), 0.1 * np.sin(np.pi * np.arange(FRAMES) / FRAMES)

    def alike(seed: int) -> Pair:
        each = pair(seed)
        seen = each.measured.curves["lv_volume"]
        true = {
            name: value / f
            for (name, value), f in zip(each.measured.observations.items(), factor, strict=True)
        }
        volume = {"lv_volume": replace(seen, values=seen.values - np.ptp(seen.values) * share)}
        return Pair(Reading(volume, true), each.measured)

    known = NoiseModel.of([alike(seed) for seed in range(20)], PROTOCOL, FRAMES)
    fresh = alike(77)
    assert known.corrected(fresh.measured.observations) == pytest.approx(fresh.true.observations)
    found = known.corrected_curve(fresh.measured.curves["lv_volume"])
    assert found.values == pytest.approx(fresh.true.curves["lv_volume"].values)
    for name, (low, high) in known.interval(fresh.measured.observations).items():
        assert low == pytest.approx(fresh.true.observations[name])
        assert high == pytest.approx(fresh.true.observations[name])


def test_the_covariance_is_that_of_the_truth_and_in_the_order_asked_for() -> None:
    known = model(1000)
    observed = {"q_min": -300e-6, "V_min": 70e-6}
    found = known.covariance(observed)
    y = np.array(list(known.corrected(observed).values()))
    assert y == pytest.approx([-300e-6 * np.exp(0.15), 70e-6 * np.exp(-0.04)], rel=0.02)
    expected = np.outer(y, y) * SPREAD[np.ix_([2, 0], [2, 0])]
    assert np.diag(found) == pytest.approx(np.diag(expected), rel=0.15)
    assert np.sign(found[0, 1]) == 1.0  # the logarithms go apart, but q_min is negative
    rng = np.random.default_rng(5)
    errors = rng.multivariate_normal(BIAS, SPREAD, 20000)[:, [2, 0]]
    truths = np.array(list(observed.values())) * np.exp(-errors)
    assert np.diag(found) == pytest.approx(truths.var(axis=0), rel=0.15)


def test_few_sequences_widen_everything_as_their_number_says() -> None:
    few = model(20)
    plain = (
        np.outer([60e-6], [60e-6])
        * few.observations.covariance[:1, :1]
        * np.exp(-2 * few.observations.mean[0])
    )
    assert few.covariance({"V_min": 60e-6}) == pytest.approx(plain * 21 / 20)
    low, high = few.interval({"q_min": -400e-6})["q_min"]
    assert low < -400e-6 * np.exp(-few.observations.mean[2]) < high < 0.0
    assert np.log(low / high) == pytest.approx(2.0 * few.observations.reach()[2])
    seen = pair(99).measured.curves["lv_volume"]
    low_curve, high_curve = few.curve_interval(seen)
    assert high_curve - low_curve == pytest.approx(2.0 * np.ptp(seen.values) * few.curve.reach(), abs=1e-12)
    assert few.curve_covariance(seen) == pytest.approx(np.ptp(seen.values) ** 2 * few.curve.predictive)


def test_intervals_hold_the_truth_of_fresh_sequences_as_often_as_they_say() -> None:
    """300 models of 20 sequences with one fresh one each: within the binomial's 99 % of 95 %."""
    held = [coverage(model(20, 1000 * trial), [pair(1000 * trial + 999)]) for trial in range(300)]
    for name in (*NAMES, "lv_volume"):
        share = np.mean([each[name].covered for each in held])
        assert abs(share - 0.95) < 2.58 * np.sqrt(0.95 * 0.05 / 300), name


def test_coverage_of_a_good_model_holds_95_percent_and_sees_a_model_that_boasts() -> None:
    known, fresh = model(1000), [pair(5000 + seed) for seed in range(400)]
    found = coverage(known, fresh)
    assert set(found) == {*NAMES, "lv_volume"}
    for share in found.values():
        assert share.sequences == 400
        assert share.low <= 0.95 <= share.high
    boasting = replace(known, observations=replace(known.observations, covariance=0.25 * SPREAD))
    assert coverage(boasting, fresh)["q_max"].high < 0.8


def test_phases_without_error_do_not_count_as_covered() -> None:
    """A truth far off in every phase but the first, which the model knows to the last bit."""
    each = pair(0)
    true, seen = each.true.curves["lv_volume"], each.measured.curves["lv_volume"]
    far = replace(true, values=np.r_[seen.values[0], seen.values[1:] - 1e-4])
    lost = replace(each, true=replace(each.true, curves={"lv_volume": far}))
    assert coverage(model(20), [lost])["lv_volume"].covered == 0.0


@pytest.mark.parametrize("covered", [0, 1, 12, 23, 24])
def test_the_interval_of_a_share_is_clopper_and_pearsons(covered: int) -> None:
    exact = binomtest(covered, 24).proportion_ci(0.95, "exact")
    found = Share.of(covered, 24)
    assert (found.low, found.high) == pytest.approx((exact.low, exact.high))


def test_what_the_model_cannot_know_is_refused() -> None:
    with pytest.raises(InputError, match="19 sequences; expected at least 20"):
        model(19)
    with pytest.raises(InputError, match="0 sequences"):
        NoiseModel.of([], PROTOCOL)
    known = model(20)
    with pytest.raises(InputError, match="19 sequences; expected at least 20"):
        replace(known, observations=replace(known.observations, count=19))
    with pytest.raises(InputError, match="knows nothing of P_max; expected V_min, q_max, q_min"):
        known.covariance({"V_min": 60e-6, "P_max": 16e3})
    with pytest.raises(InputError, match=r"snr is 10\.0, the model was made for 30\.0"):
        known.require_protocol(PROTOCOL | {"snr": 10.0})
    with pytest.raises(InputError, match="phases is None, the model was made for 25"):
        replace(known, protocol={**PROTOCOL, "phases": 25}).require_protocol(PROTOCOL)
    known.require_protocol(dict(PROTOCOL))


def test_sequences_that_were_not_observed_alike_are_refused() -> None:
    pairs = [pair(seed) for seed in range(20)]
    wrong = replace(pairs[3].measured, observations=pairs[3].measured.observations | {"q_max": -1e-4})
    with pytest.raises(InputError, match=r"sequence 3 has q_max = -0\.0001 for a true"):
        NoiseModel.of([*pairs[:3], replace(pairs[3], measured=wrong), *pairs[4:]], PROTOCOL)
    lacking = replace(pairs[5].true, observations={"V_min": 6e-5})
    with pytest.raises(InputError, match="sequence 5 has the observations V_min"):
        NoiseModel.of([*pairs[:5], replace(pairs[5], true=lacking), *pairs[6:]], PROTOCOL)

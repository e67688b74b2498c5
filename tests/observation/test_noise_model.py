"""A planted distortion is recovered and corrected; its intervals cover the truth at their nominal rate."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binomtest

from heartfit.core.errors import InputError
from heartfit.observation.curve import Curve
from heartfit.observation.noise_model import NoiseModel, Share, coverage
from heartfit.observation.operator import Pair, Reading, VolumeFeatures
from heartfit.observation.scatter import Scatter

NAMES = ("V_min", "q_max", "q_min")
BIAS = np.array([0.04, -0.2, -0.15])
SPREAD = np.array([[1.0, -0.5, -0.2], [-0.5, 9.0, 4.0], [-0.2, 4.0, 6.0]]) * 1e-3
FRAMES = 10
PROTOCOL = {"snr": 30.0, "slice_thickness": 0.008}


@pytest.mark.parametrize(("bias", "sd"), [(0.0, 0.1), (0.04, 0.1), (-0.2, 0.01)])
def test_the_mean_unsigned_error_is_that_of_normal_draws(bias: float, sd: float) -> None:
    scatter = Scatter(("q_max",), 20, np.array([bias]), np.array([[sd**2]]))
    drawn = bias + sd * np.random.default_rng(0).standard_normal(10**6)
    assert NoiseModel({}, scatter, {"lv_volume": scatter}).mean_unsigned_error("q_max") == pytest.approx(
        np.abs(drawn).mean(), rel=3e-3
    )


def planted_curve(rng: np.random.Generator) -> np.ndarray:
    """Error over the measured stroke volume (10,): none in phase 0, then 3 % and 2 % that go together."""
    wave = np.sin(np.pi * np.arange(FRAMES) / FRAMES)
    return wave * (0.03 + 0.02 * rng.standard_normal() + 0.005 * rng.standard_normal(FRAMES))


def truth(measured: Reading, errors: np.ndarray) -> dict[str, float]:
    """True observations of a reading with given errors: of V_min over the stroke volume, of the rates in logarithms."""
    y, stroke = measured.observations, np.ptp(measured.curves["lv_volume"].values)
    rates = {name: y[name] * np.exp(-error) for name, error in zip(NAMES[1:], errors[1:], strict=True)}
    return {"V_min": y["V_min"] - stroke * errors[0], **rates}


def pair(seed: int) -> Pair:
    """A measured beat of any size and the truth behind it, errors as planted."""
    rng = np.random.default_rng(seed)
    size, stroke = np.exp(0.2 * rng.standard_normal(2))
    times = 0.8 / FRAMES * np.arange(FRAMES)
    values = (120.0 + 35.0 * stroke * np.cos(2.0 * np.pi * times / 0.8)) * 1e-6
    observed = dict(zip(NAMES, size * np.array([60e-6, 350e-6, -400e-6]), strict=True))
    measured = Reading({"lv_volume": Curve(times, values, 0.8)}, observed)
    behind = {"lv_volume": Curve(times, values - np.ptp(values) * planted_curve(rng), 0.8)}
    return Pair(Reading(behind, truth(measured, rng.multivariate_normal(BIAS, SPREAD))), measured)


def model(sequences: int, first: int = 0) -> NoiseModel:
    return NoiseModel.from_pairs([pair(first + seed) for seed in range(sequences)], PROTOCOL, FRAMES)


def test_planted_bias_and_covariance_are_recovered_within_their_sampling_error() -> None:
    estimated = model(1000)
    variance = np.diag(SPREAD)
    assert (np.abs(estimated.observations.mean - BIAS) < 3.0 * np.sqrt(variance / 1000)).all()
    error = np.sqrt((SPREAD**2 + np.outer(variance, variance)) / 1000)
    assert (np.abs(estimated.observations.covariance - SPREAD) < 3.0 * error).all()
    wave = np.sin(np.pi * np.arange(FRAMES) / FRAMES)
    sd = wave * np.hypot(0.02, 0.005)
    assert (
        np.abs(estimated.curves["lv_volume"].mean - 0.03 * wave) <= 3.0 * sd / np.sqrt(1000) + 1e-15
    ).all()
    assert estimated.curves["lv_volume"].sd == pytest.approx(sd, rel=3.0 / np.sqrt(2000), abs=1e-15)
    together = estimated.curves["lv_volume"].covariance[3, 6] / (
        estimated.curves["lv_volume"].sd[3] * estimated.curves["lv_volume"].sd[6]
    )
    assert together == pytest.approx(0.02**2 / (0.02**2 + 0.005**2), abs=0.01)


def test_the_known_error_is_subtracted_exactly() -> None:
    """Sequences with equal errors: the corrected observations and curve are the truth, for every size."""
    share = 0.1 * np.sin(np.pi * np.arange(FRAMES) / FRAMES)

    def with_equal_errors(seed: int) -> Pair:
        drawn = pair(seed)
        volume_curve = drawn.measured.curves["lv_volume"]
        volume = {
            "lv_volume": replace(
                volume_curve, values=volume_curve.values - np.ptp(volume_curve.values) * share
            )
        }
        return Pair(Reading(volume, truth(drawn.measured, BIAS)), drawn.measured)

    known = NoiseModel.from_pairs([with_equal_errors(seed) for seed in range(20)], PROTOCOL, FRAMES)
    fresh = with_equal_errors(77)
    assert known.corrected(fresh.measured) == pytest.approx(fresh.true.observations)
    corrected = known.corrected_curve(fresh.measured.curves["lv_volume"])
    assert corrected.values == pytest.approx(fresh.true.curves["lv_volume"].values)
    for name, (low, high) in known.interval(fresh.measured).items():
        assert low == pytest.approx(fresh.true.observations[name])
        assert high == pytest.approx(fresh.true.observations[name])


def test_each_volume_is_corrected_by_the_error_of_its_own_ventricle() -> None:
    """The right volume errs by the opposite of the left one."""

    def with_right(drawn: Pair) -> Pair:
        left, true = (one.curves["lv_volume"] for one in (drawn.measured, drawn.true))
        right = replace(true, values=true.values + 2.0 * (left.values - true.values))
        readings = [
            replace(one, curves={"lv_volume": one.curves["lv_volume"], "rv_volume": shown})
            for one, shown in ((drawn.true, right), (drawn.measured, left))
        ]
        return Pair(*readings)

    estimated = NoiseModel.from_pairs([with_right(pair(seed)) for seed in range(40)], PROTOCOL, FRAMES)
    fresh = with_right(pair(77))
    error = {
        name: estimated.corrected_curve(fresh.measured.curves[name], name).values
        - fresh.true.curves[name].values
        for name in estimated.curves
    }
    assert error["rv_volume"] == pytest.approx(-error["lv_volume"], rel=1e-6, abs=1e-12)
    covered = coverage(estimated, [with_right(pair(seed)) for seed in range(100, 160)])
    assert covered["rv_volume"].covered == pytest.approx(covered["lv_volume"].covered)
    assert covered["rv_volume"].covered > 0.9


def test_a_shrunken_motion_has_the_same_error_for_every_heart() -> None:
    """V' = V_0 - (1 - s)(V_0 - V): all errors are s / (1 - s) of the stroke at end systole, ln(1 - s) of the rates."""
    features, s = {"lv_volume": VolumeFeatures(FRAMES)}, 0.2

    def shrunken(seed: int) -> Pair:
        true = pair(seed).true.curves["lv_volume"]
        smaller = replace(true, values=true.values[0] - (1.0 - s) * (true.values[0] - true.values))
        return Pair(*(Reading.from_curves({"lv_volume": curve}, features) for curve in (true, smaller)))

    estimated = NoiseModel.from_pairs([shrunken(seed) for seed in range(20)], PROTOCOL, FRAMES)
    strokes = [np.ptp(pair(seed).true.curves["lv_volume"].values) for seed in range(20)]
    assert max(strokes) > 1.5 * min(strokes)
    assert estimated.observations.mean == pytest.approx(
        [s / (1.0 - s), np.log(1.0 - s), np.log(1.0 - s)], rel=0.03
    )
    assert estimated.observations.sd == pytest.approx(np.zeros(3), abs=0.02)


def test_the_covariance_is_that_of_the_truth_and_in_the_order_asked_for() -> None:
    known, reading = model(1000), pair(3).measured
    reordered = replace(reading, observations={"q_min": -300e-6, "V_min": 70e-6})
    covariance, stroke = known.covariance(reordered), np.ptp(reading.curves["lv_volume"].values)
    rng = np.random.default_rng(5)
    errors = rng.multivariate_normal(BIAS, SPREAD, 20000)
    truths = np.array([-300e-6 * np.exp(-errors[:, 2]), 70e-6 - stroke * errors[:, 0]])
    assert np.sqrt(np.diag(covariance)) == pytest.approx(truths.std(axis=1), rel=0.08)
    size = np.outer(np.sqrt(np.diag(covariance)), np.sqrt(np.diag(covariance)))
    assert covariance / size == pytest.approx(np.corrcoef(truths), abs=0.08)
    assert list(known.corrected(reordered).values()) == pytest.approx(np.median(truths, axis=1), rel=0.01)


def test_few_sequences_widen_intervals_by_their_number() -> None:
    few, reading = model(20), pair(99).measured
    volume = reading.curves["lv_volume"]
    stroke, scatter = np.ptp(volume.values), few.observations
    plain = stroke**2 * scatter.covariance[0, 0]
    assert few.covariance(reading)[0, 0] == pytest.approx(plain * 21 / 20, rel=1e-12, abs=0.0)
    low, high = few.interval(reading)["q_min"]
    assert low < few.corrected(reading)["q_min"] < high < 0.0
    assert np.log(low / high) == pytest.approx(2.0 * scatter.half_width()[2])
    low, high = few.interval(reading)["V_min"]
    assert (low + high) / 2.0 == pytest.approx(few.corrected(reading)["V_min"])
    assert high - low == pytest.approx(2.0 * stroke * scatter.half_width()[0], rel=1e-12, abs=0.0)
    low_curve, high_curve = few.curve_interval(volume)
    assert high_curve - low_curve == pytest.approx(
        2.0 * stroke * few.curves["lv_volume"].half_width(), abs=1e-12
    )
    assert few.curve_covariance(volume) == pytest.approx(
        stroke**2 * few.curves["lv_volume"].predictive, rel=1e-12, abs=0.0
    )


def test_a_peak_pressure_is_compared_with_the_range_of_the_pressure() -> None:
    def recorded(seed: int) -> Pair:
        drawn, times = pair(seed), 0.8 / 200 * np.arange(200)
        wave = Curve(times, (8e3 + 50.0 * seed) * (1.0 - np.cos(2.0 * np.pi * times / 0.8)), 0.8)
        range_ = np.ptp(wave.values)
        observed = drawn.measured.observations | {"P_max": wave.values.max()}
        true = drawn.true.observations | {"P_max": wave.values.max() - 0.03 * range_}
        curves = drawn.measured.curves | {"lv_pressure": wave}
        return Pair(replace(drawn.true, observations=true), Reading(curves, observed))

    known = NoiseModel.from_pairs([recorded(seed) for seed in range(20)], PROTOCOL, FRAMES)
    assert known.observations.mean[3] == pytest.approx(0.03)
    fresh = recorded(40)
    assert known.corrected(fresh.measured)["P_max"] == pytest.approx(fresh.true.observations["P_max"])


def test_intervals_cover_the_truth_of_new_sequences_at_their_nominal_rate() -> None:
    """300 models of 20 sequences, each with one new sequence: within the binomial's 99 % of 95 %."""
    held = [coverage(model(20, 1000 * trial), [pair(1000 * trial + 999)]) for trial in range(300)]
    for name in (*NAMES, "lv_volume"):
        share = np.mean([intervals[name].covered for intervals in held])
        assert abs(share - 0.95) < 2.58 * np.sqrt(0.95 * 0.05 / 300), name


def test_coverage_of_a_good_model_is_95_percent_and_reveals_an_overconfident_one() -> None:
    known, fresh = model(1000), [pair(5000 + seed) for seed in range(400)]
    shares = coverage(known, fresh)
    assert set(shares) == {*NAMES, "lv_volume"}
    for share in shares.values():
        assert share.sequences == 400
        assert share.low <= 0.95 <= share.high
    boasting = replace(known, observations=replace(known.observations, covariance=0.25 * SPREAD))
    assert coverage(boasting, fresh)["q_max"].high < 0.8


def test_phases_without_error_do_not_count_as_covered() -> None:
    """True curve far from the measured one in every phase except the first, which has no error."""
    drawn = pair(0)
    true, volume = drawn.true.curves["lv_volume"], drawn.measured.curves["lv_volume"]
    far = replace(true, values=np.r_[volume.values[0], volume.values[1:] - 1e-4])
    lost = replace(drawn, true=replace(drawn.true, curves={"lv_volume": far}))
    assert coverage(model(20), [lost])["lv_volume"].covered == 0.0


@pytest.mark.parametrize("covered", [0, 1, 12, 23, 24])
def test_the_interval_of_a_share_is_clopper_and_pearsons(covered: int) -> None:
    exact = binomtest(covered, 24).proportion_ci(0.95, "exact")
    share = Share.from_count(covered, 24)
    assert (share.low, share.high) == pytest.approx((exact.low, exact.high))


def test_observations_unknown_to_the_noise_model_are_refused() -> None:
    with pytest.raises(InputError, match=r"\b19\b.*\b20\b"):
        model(19)
    with pytest.raises(InputError, match=r"\b0\b.*\b20\b"):
        NoiseModel.from_pairs([], PROTOCOL)
    known = model(20)
    with pytest.raises(InputError, match=r"\b19\b.*\b20\b"):
        replace(known, observations=replace(known.observations, count=19))
    with pytest.raises(InputError, match=r"P_max.*V_min, q_max, q_min"):
        known.covariance(replace(pair(0).measured, observations={"V_min": 60e-6, "P_max": 16e3}))
    with pytest.raises(InputError, match=r"snr.*10\.0.*30\.0"):
        known.require_protocol(PROTOCOL | {"snr": 10.0})
    with pytest.raises(InputError, match=r"phases.*None.*\b25\b"):
        replace(known, protocol={**PROTOCOL, "phases": 25}).require_protocol(PROTOCOL)
    known.require_protocol(dict(PROTOCOL))


def test_sequences_with_different_observations_are_refused() -> None:
    pairs = [pair(seed) for seed in range(20)]
    wrong = replace(pairs[3].measured, observations=pairs[3].measured.observations | {"q_max": -1e-4})
    with pytest.raises(InputError, match=r"\b3\b.*q_max.*-0\.0001"):
        NoiseModel.from_pairs([*pairs[:3], replace(pairs[3], measured=wrong), *pairs[4:]], PROTOCOL)
    lacking = replace(pairs[5].true, observations={"V_min": 6e-5})
    with pytest.raises(InputError, match=r"\b5\b.*V_min"):
        NoiseModel.from_pairs([*pairs[:5], replace(pairs[5], true=lacking), *pairs[6:]], PROTOCOL)

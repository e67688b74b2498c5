"""Noise of all regional curves: recovered, covering, without error in phase 0, and refused for too few sequences."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.observation.curve import Curve
from heartfit.observation.gain_noise import GainNoise
from heartfit.observation.noise_model import MIN_SEQUENCES
from heartfit.observation.regional import (
    BASE_DESCENT,
    CIRCUMFERENTIAL,
    KINDS,
    LONGITUDINAL,
    names_of_kind,
    strain_name,
)
from heartfit.observation.regional_noise import RegionalNoise, RegionalPair, later_samples, leave_one_out

PERIOD = 0.9
TIMES = np.arange(15) * PERIOD / 15
KNOWN = RegionalNoise(
    {
        CIRCUMFERENTIAL: GainNoise(0.9, 0.05, 0.1, 0.008, 0.1, 0.0, 100),
        LONGITUDINAL: GainNoise(1.1, 0.0, 0.2, 0.012, 0.15, 0.1, 100),
        BASE_DESCENT: GainNoise(0.95, 0.05, 0.0, 2e-4, 0.06, 0.0, 100),
    }
)
SIZES = {CIRCUMFERENTIAL: -0.2, LONGITUDINAL: -0.14, BASE_DESCENT: 0.012}


def pair(rng: np.random.Generator) -> RegionalPair:
    """True curves of any size, and registered ones drawn from the known noise."""
    pulse = np.sin(np.pi * TIMES / PERIOD) ** 2
    true = {
        name: Curve(TIMES, SIZES[kind] * np.exp(0.2 * rng.standard_normal()) * pulse, PERIOD)
        for kind in KINDS
        for name in names_of_kind(kind)
    }
    errors = {name: error for kind in KINDS for name, error in kind_errors(true, kind, rng).items()}
    registered = {
        name: replace(curve, values=curve.values + errors[name])
        for name, curve in KNOWN.expected(true).items()
    }
    return RegionalPair(true, registered)


def kind_errors(true: Mapping[str, Curve], kind: str, rng: np.random.Generator) -> dict[str, Floats]:
    """Errors of the curves of one kind, on which the other kinds have no influence."""
    curves = {name: true[name] for name in names_of_kind(kind)}
    values, vectors = np.linalg.eigh(KNOWN.covariance(curves))
    error = vectors @ (np.sqrt(np.maximum(values, 0.0)) * rng.standard_normal(values.size))
    return dict(zip(curves, error.reshape(len(curves), -1), strict=True))


def pairs(count: int, seed: int = 0) -> list[RegionalPair]:
    rng = np.random.default_rng(seed)
    return [pair(rng) for _ in range(count)]


def test_each_kind_has_its_own_noise() -> None:
    estimated = RegionalNoise.from_pairs(pairs(100))
    for kind, known in KNOWN.kinds.items():
        one = estimated.kinds[kind]
        assert one.gain == pytest.approx(known.gain, abs=0.02)
        assert one.common_sd == pytest.approx(known.common_sd, abs=0.02)
        assert one.element_sd == pytest.approx(known.element_sd, rel=0.15)
        assert one.sd == pytest.approx(known.sd, rel=0.15)
        assert one.shared == pytest.approx(known.shared, abs=0.03)


def test_the_correction_divides_by_the_gain() -> None:
    drawn = pair(np.random.default_rng(1))
    again = KNOWN.corrected(KNOWN.expected(drawn.true))
    for name, curve in drawn.true.items():
        assert again[name].values == pytest.approx(curve.values)
    covariance, corrected = KNOWN.covariance(drawn.true), KNOWN.corrected_covariance(drawn.true)
    assert corrected[20, 20] == pytest.approx(covariance[20, 20] / 0.9**2)
    assert corrected[-1, -1] == pytest.approx(covariance[-1, -1] / 0.95**2)


def test_samples_after_phase_0_have_a_positive_definite_covariance() -> None:
    drawn = pair(np.random.default_rng(2))
    covariance, later = KNOWN.covariance(drawn.true), later_samples(drawn.true)
    assert later.size == 33 * 14
    references = np.setdiff1d(np.arange(len(covariance)), later)
    assert references.tolist() == list(range(0, 33 * 15, 15))
    assert not covariance[references].any()
    np.linalg.cholesky(covariance[np.ix_(later, later)])


def test_the_covariance_follows_the_order_of_the_curves() -> None:
    drawn = pair(np.random.default_rng(3))
    names = list(drawn.true)
    order = np.random.default_rng(4).permutation(len(names))
    turned = {names[place]: drawn.true[names[place]] for place in order}
    rows = (order[:, None] * TIMES.size + np.arange(TIMES.size)).ravel()
    assert KNOWN.covariance(turned) == pytest.approx(KNOWN.covariance(drawn.true)[np.ix_(rows, rows)])


def test_kinds_may_be_measured_alone() -> None:
    drawn = pair(np.random.default_rng(5))
    base = {BASE_DESCENT: drawn.true[BASE_DESCENT]}
    assert KNOWN.covariance(base) == pytest.approx(KNOWN.covariance(drawn.true)[-15:, -15:])


def test_left_out_sequences_are_covered() -> None:
    """The mean of chi-square over n = 16 x 14 samples x 40 sequences has a standard error of a hundredth."""
    sample = pairs(40, seed=6)
    judges = leave_one_out(sample)
    for kind in (CIRCUMFERENTIAL, LONGITUDINAL):
        chi_squares = [judge.reduced_chi_square(one, kind) for judge, one in zip(judges, sample, strict=True)]
        assert np.mean(chi_squares) == pytest.approx(1.0, abs=0.1)


def test_the_density_is_highest_for_the_noise_that_was_drawn() -> None:
    sample = pairs(30, seed=7)
    widened = {kind: replace(one, sd=2.0 * one.sd) for kind, one in KNOWN.kinds.items()}
    narrowed = {kind: replace(one, sd=0.5 * one.sd) for kind, one in KNOWN.kinds.items()}
    for kind in KINDS:
        best, *others = (
            np.mean([noise.log_density(one, kind) for one in sample])
            for noise in (KNOWN, RegionalNoise(widened), RegionalNoise(narrowed))
        )
        assert best > max(others)


def test_the_density_is_that_of_the_normal_distribution() -> None:
    from scipy.stats import multivariate_normal

    drawn = pair(np.random.default_rng(8))
    base = {BASE_DESCENT: drawn.true[BASE_DESCENT]}
    mean = KNOWN.expected(base)[BASE_DESCENT].values[1:]
    normal = multivariate_normal(mean, KNOWN.covariance(base)[1:, 1:])
    expected = normal.logpdf(drawn.registered[BASE_DESCENT].values[1:]) / 14
    assert KNOWN.log_density(drawn, BASE_DESCENT) == pytest.approx(expected)


def test_too_few_sequences_are_refused() -> None:
    sample = pairs(MIN_SEQUENCES)
    RegionalNoise.from_pairs(sample)
    with pytest.raises(InputError, match=f"{MIN_SEQUENCES - 1} sequences"):
        RegionalNoise.from_pairs(sample[1:])
    with pytest.raises(InputError, match=f"{MIN_SEQUENCES - 1} sequences"):
        leave_one_out(sample)


def test_a_pair_without_all_curves_or_of_other_times_is_refused() -> None:
    drawn = pair(np.random.default_rng(9))
    name = strain_name(LONGITUDINAL, 3)
    without = {other: curve for other, curve in drawn.true.items() if other != name}
    with pytest.raises(InputError, match=f"no curve {name}"):
        RegionalPair(without, drawn.registered)
    later = {**drawn.true, name: drawn.true[name].shifted(-0.01)}
    with pytest.raises(InputError, match="times of the curves differ"):
        RegionalPair(later, drawn.registered)
    with pytest.raises(InputError, match=f"no curve {name}"):
        KNOWN.covariance(without)

"""Ranking of effects of a model that is no heart, given as a function of named parameters."""

from math import inf

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.discovery.inference.data import Block, Data, Noise, Whitening
from heartfit.discovery.inference.rank_effects import rank_effects

TIMES = np.linspace(0.0, 20.0, 81)
BASE = {"omega": (1.5, 0.1), "gamma": (0.05, 0.02)}
EFFECTS = {"delay": 0.2, "drift": 0.02, "step": 0.1}


def oscillator(omega, gamma, delay=0.0, drift=0.0, step=0.0):
    t = TIMES - delay
    return np.exp(-gamma * t) * np.cos(omega * t) + drift * TIMES + step * (TIMES > 10.0)


def recorded(seed=1, **effects):
    noise = 0.05 * np.random.default_rng(seed).standard_normal(TIMES.size)
    return oscillator(1.55, 0.06, **effects) + noise


@pytest.mark.parametrize(("name", "size"), [("delay", 0.3), ("drift", 0.02), ("step", 0.2)])
def test_the_planted_effect_is_named_with_its_size(name, size):
    result = rank_effects(oscillator, TIMES, recorded(**{name: size}), BASE, EFFECTS, sd=0.05)
    assert (result.verdict, result.named) == ("named", (name,))
    assert next(iter(result.ranking)) == name
    assert result.ranking.keys() == {*EFFECTS, "unknown"}
    _, low, high = result.sizes[name]
    assert low < size < high
    assert repr(result).startswith(f"RankedEffects(named {name}; ln Bayes factors: {name} ")


def test_nothing_is_named_without_an_effect():
    result = rank_effects(oscillator, TIMES, recorded(), BASE, EFFECTS, sd=[0.03, 0.05])
    assert (result.verdict, result.named, result.notes) == ("none", (), ())


def test_an_effect_of_another_shape_is_unknown():
    bump = 0.3 * np.exp(-0.5 * ((TIMES - 8.0) / 2.0) ** 2)
    result = rank_effects(oscillator, TIMES, recorded() + bump, BASE, {"delay": 0.2}, sd=0.05)
    assert result.verdict == "unknown"
    assert next(iter(result.ranking)) == "unknown"


def test_an_effect_of_unknown_sign_may_be_negative():
    measured = recorded(drift=-0.02)
    one_sided, signed = (
        rank_effects(oscillator, TIMES, measured, BASE, EFFECTS, sd=0.05, signed=signs)
        for signs in ((), ["drift"])
    )
    assert signed.named == ("drift",)
    assert signed.sizes["drift"][2] < 0.0
    assert one_sided.named != ("drift",)


def similar(omega, gamma, early=0.0, late=0.0):
    """Two effects with nearly one shape."""
    shapes = np.exp(-0.5 * ((TIMES - 9.7) / 2.0) ** 2), np.exp(-0.5 * ((TIMES - 10.3) / 2.0) ** 2)
    return oscillator(omega, gamma) + early * shapes[0] + late * shapes[1]


def test_a_ranking_that_a_scale_decides_says_so():
    measured = similar(1.55, 0.06, early=0.3) + 0.05 * np.random.default_rng(1).standard_normal(TIMES.size)
    narrow, fitting = (
        rank_effects(similar, TIMES, measured, BASE, {"early": scale, "late": 0.3}, sd=0.05)
        for scale in (0.04, 0.3)
    )
    assert next(iter(narrow.ranking)) == "late"
    (note,) = [note for note in narrow.notes if "scale of early" in note]
    assert note.startswith("the ranking depends on the scale of early, 0.04: late (")
    assert "; with 4 times this scale early (" in note
    assert next(iter(fitting.ranking)) == "early"
    assert not [note for note in fitting.notes if "4 times this scale late" in note]


def test_an_effect_that_a_scale_hides_behind_the_unknown_says_so():
    measured = recorded(step=0.12)
    narrow, fitting = (
        rank_effects(oscillator, TIMES, measured, BASE, {"step": scale, "delay": 0.2}, sd=0.05)
        for scale in (0.015, 0.1)
    )
    assert (narrow.verdict, fitting.verdict) == ("unknown", "named")
    (note,) = narrow.notes
    assert note.startswith("the ranking depends on the scale of step, 0.015: unknown (")
    assert "; with 4 times this scale step (" in note
    assert fitting.notes == ()


def test_a_detection_that_a_scale_hides_says_so():
    rough = {"unknown": 1.0, "length": 0.5}
    result = rank_effects(
        oscillator, TIMES, recorded(drift=0.0025), BASE, {"drift": 0.0003}, sd=0.05, **rough
    )
    assert result.verdict == "none"
    (note,) = result.notes
    assert "scale of drift, 0.0003: nothing; with 4 times this scale drift (8" in note


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"effects": {"delay": 0.0}}, "expected positive numbers"),
        ({"effects": {"omega": 0.1}}, "omega in base and effects"),
        ({"signed": ["lag"]}, "signed names lag; expected some of delay"),
        ({"model": lambda **_: np.zeros(3)}, r"returns the shape \(3,\); expected \(81,\)"),
        ({"model": lambda **_: None}, "at the centre of the priors fails"),
        ({"period": 0.0}, "block series: period = 0; expected a positive time"),
    ],
)
def test_a_wrong_question_is_refused(changes, message):
    question = {
        "model": oscillator,
        "times": TIMES,
        "values": recorded(),
        "base": BASE,
        "effects": EFFECTS,
        "sd": 0.05,
    }
    with pytest.raises(InputError, match=message):
        rank_effects(**question | changes)


def test_white_noise_is_independent_and_an_unknown_effect_smooth():
    noise = Noise.white(0.1, discrepancy=0.5, length=3.0)
    assert noise.covariance(TIMES, inf, noise.middle) == pytest.approx(0.01 * np.eye(81))
    lags = TIMES[:, None] - TIMES
    assert noise.discrepancy_covariance(TIMES, TIMES, inf) == pytest.approx(
        0.25 * np.exp(-0.5 * (lags / 3.0) ** 2)
    )
    assert Noise.white([0.1, 0.2], 0.5, 3.0).levels == (0.1, 0.2)


def test_a_long_period_is_as_good_as_none():
    noise = Noise((0.1,), 0.7, 0.05, 0.5, 2.0, 3.0)
    data = [Data(np.zeros(81), (Block("x", "1", TIMES, period, noise),)) for period in (inf, 1e6)]
    endless, long = (Whitening.from_data(each_data, 1.0).log_likelihood(np.sin(TIMES)) for each_data in data)
    assert endless == pytest.approx(long, rel=1e-6)

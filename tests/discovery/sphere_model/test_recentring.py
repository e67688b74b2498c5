"""A centred sphere must follow its beat and pass its self-test, else the rules are stricter; curves in closed form."""

from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.inference.data import Block, Data, Noise
from heartfit.discovery.inference.decide import DEFAULT_RULES, Rules
from heartfit.discovery.sphere_model import recentred as module
from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.discovery.sphere_model.nominal_heart import ADULT, NominalHeart
from heartfit.discovery.sphere_model.recentred import centred_search, fit_nominal_heart, recorded, self_test
from heartfit.discovery.sphere_model.recording import Recording, Samples
from heartfit.heart.heart import Heart
from heartfit.observation.curve import Curve

PERIOD = ADULT.heart.period
TIMES = np.arange(80) * PERIOD / 80
WAVE = np.cos(2.0 * np.pi * TIMES / PERIOD)
BEAT = {
    "lv_volume": Curve(TIMES, 100e-6 + 40e-6 * WAVE, PERIOD),
    "lv_pressure": Curve(TIMES, 8e3 - 7e3 * WAVE, PERIOD),
}
RECORDING, UNSEEN = (
    Recording(
        PERIOD, {name: Samples(curve.times[part::2], curve.values[part::2]) for name, curve in BEAT.items()}
    )
    for part in (0, 1)
)


@pytest.mark.parametrize(
    ("errors", "recorded_curves", "followed"),
    [
        ((0.69e-6, 99.0), ("lv_volume", "lv_pressure"), True),
        ((0.71e-6, 99.0), ("lv_volume", "lv_pressure"), False),
        ((0.69e-6, 101.0), ("lv_volume", "lv_pressure"), False),
        ((0.69e-6, 1e4), ("lv_volume",), True),
        ((1.0, 1e4), (), True),
    ],
    ids=["close", "volume-off", "pressure-off", "pressure-not-recorded", "nothing-recorded"],
)
def test_a_sphere_follows_the_recorded_curves_within_0_7_ml_and_0_1_kpa(
    monkeypatch: pytest.MonkeyPatch,
    errors: tuple[float, float],
    recorded_curves: tuple[str, ...],
    followed: bool,
) -> None:
    """The sphere misses every sample by this error, one after the other too high and too low."""

    def missed(nominal: NominalHeart, data: Data) -> tuple[NominalHeart, Floats]:
        signs = [np.where(np.arange(block.times.size) % 2, -1.0, 1.0) for block in data.blocks]
        return nominal, data.values + np.concatenate(
            [error * sign for error, sign in zip(errors, signs, strict=True)]
        )

    monkeypatch.setattr(module, "_fit", missed)
    if followed:
        assert fit_nominal_heart(ADULT.heart, BEAT, recorded_curves).heart.period == PERIOD
    else:
        with pytest.raises(InputError, match="the sphere leaves"):
            fit_nominal_heart(ADULT.heart, BEAT, recorded_curves)


def test_the_sphere_is_the_heart_of_the_beat_with_a_weaker_muscle(monkeypatch: pytest.MonkeyPatch) -> None:
    """A sphere that needs no fit keeps every parameter, but all its fibres pull in the plane of the wall."""
    monkeypatch.setattr(module, "_fit", lambda nominal, data: (nominal, data.values))
    heart = ADULT.heart.with_parameters({"R_p": 1.6e8, "mu": 12e3, "sigma_0": 300e3})
    values, of_beat = fit_nominal_heart(heart, BEAT).heart.parameters(), heart.parameters()
    assert {name for name in values if values[name] != of_beat[name]} == {heart.parameter_path("sigma_0")}
    assert 0.4 < values[heart.parameter_path("sigma_0")] / 300e3 < 0.8


def test_the_self_test_is_the_median_of_the_largest_factors(monkeypatch: pytest.MonkeyPatch) -> None:
    factors = iter([0.2, 9.0, 1.1])
    monkeypatch.setattr(module, "largest_log_bayes_factor", lambda *_: next(factors))
    assert self_test(RECORDING, ADULT, [BEAT] * 3) == 1.1


def test_beats_of_a_self_test_are_recorded_with_the_noise_of_the_instruments_only() -> None:
    times = np.arange(400) * PERIOD / 400
    block = Block("lv_pressure", "Pa", times, PERIOD, Noise((50.0, 100.0, 200.0), 0.0, 1000.0, 0.0))
    like = Data(np.zeros(400), (block,))
    error = recorded(like, BEAT, np.random.default_rng(0)).values - BEAT["lv_pressure"](times)
    assert np.std(error) == pytest.approx(100.0, rel=0.1)


Search = tuple[float, Recording | None, NominalHeart | None]
"""Threshold of a search, the recording that was kept from it, and its sphere."""
CENTRED = replace(ADULT, wall=1.3 * ADULT.wall)


@pytest.fixture
def searched(monkeypatch: pytest.MonkeyPatch) -> list[Search]:
    """The searches, none of which is done."""
    calls: list[Search] = []

    def diagnosed(
        recording: Recording,
        nominal: NominalHeart | None = None,
        rules: Rules = DEFAULT_RULES,
        unseen: Recording | None = None,
        **searched: Collection[object],
    ) -> Diagnosis:
        assert searched == {"places": (), "left_out": ()}
        calls.append((rules.detected, unseen, nominal))
        return Diagnosis("none", (), (), "", (), 0, recording.period, rules.detected)

    monkeypatch.setattr(module, "diagnose", diagnosed)
    return calls


@pytest.mark.parametrize(
    ("follows", "tested", "threshold"),
    [
        (("lv_volume", "lv_pressure"), None, 7.0),
        (("lv_volume", "lv_pressure"), 1.5, 7.0),
        (("lv_volume", "lv_pressure"), 1.6, 10.0),
        ((), None, 10.0),
        ((), 0.2, 10.0),
        (None, None, 10.0),
    ],
    ids=["close", "passes", "fails", "loose", "loose-but-passes", "no-sphere"],
)
def test_a_doubtful_sphere_has_the_strict_threshold_and_what_judges_is_never_searched(
    monkeypatch: pytest.MonkeyPatch,
    searched: list[Search],
    follows: tuple[str, ...] | None,
    tested: float | None,
    threshold: float,
) -> None:
    """follows: curves that the sphere follows well enough, None where it does not beat."""

    def fitted(heart: Heart, beat: Mapping[str, Curve], required: tuple[str, ...]) -> NominalHeart:
        assert (heart, beat) == (ADULT.heart, BEAT)
        if follows is None or not set(required) <= set(follows):
            raise InputError("the sphere does not follow")
        return CENTRED

    def self_tested(_: Recording, sphere: NominalHeart, beats: list[Mapping[str, Curve]]) -> float | None:
        assert sphere is CENTRED
        assert beats == others, "neither the beat of the centre nor a failed one"
        return tested

    monkeypatch.setattr(module, "fit_nominal_heart", fitted)
    monkeypatch.setattr(module, "self_test", self_tested)
    others = [] if tested is None else [{name: curve.shifted(0.1) for name, curve in BEAT.items()}]
    result = centred_search(RECORDING, ADULT.heart, [BEAT, *others, {}], UNSEEN)
    assert searched == [(threshold, UNSEEN, None if follows is None else CENTRED)]
    assert result.self_test == tested

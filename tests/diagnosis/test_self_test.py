"""A centre is good if the search finds nothing in beats in which nothing is hidden."""

import numpy as np
import pytest

from heartfit.diagnosis import self_test as module
from heartfit.diagnosis.centre import HUMAN
from heartfit.diagnosis.free import moved
from heartfit.diagnosis.library import BASE
from heartfit.diagnosis.record import data_of
from heartfit.diagnosis.recording import Recording, Samples
from heartfit.diagnosis.self_test import LARGEST, recorded, self_test
from heartfit.diagnosis.twin import NUMERICS
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve

POINTS = np.random.default_rng(0).normal(0.0, 0.7, (3, len(BASE)))
FEW = ("CatheterDelay", "CatheterOffset", "ImageTriggerDelay")


def curves(x: np.ndarray) -> dict[str, Curve]:
    return beat_curves(moved(HUMAN, x).beat(NUMERICS))


@pytest.fixture(scope="module")
def beats() -> list[dict[str, Curve]]:
    return [curves(x) for x in POINTS]


@pytest.fixture(scope="module")
def recording(beats: list[dict[str, Curve]]) -> Recording:
    shown = {
        "lv_volume": beats[0]["lv_volume"].resampled(28),
        "lv_pressure": beats[0]["lv_pressure"].resampled(86),
    }
    samples = {name: Samples(curve.times, curve.values) for name, curve in shown.items()}
    return Recording(HUMAN.heart.period, samples)


@pytest.fixture(autouse=True)
def _few(monkeypatch: pytest.MonkeyPatch) -> None:
    every = module.candidates
    monkeypatch.setattr(module, "candidates", lambda twin: {name: every(twin)[name] for name in FEW})


def test_nothing_is_found_in_beats_of_the_sphere_itself(
    recording: Recording, beats: list[dict[str, Curve]]
) -> None:
    assert self_test(recording, HUMAN, beats) < LARGEST


def test_a_centre_whose_pressure_comes_early_fails(
    recording: Recording, beats: list[dict[str, Curve]]
) -> None:
    late = [beat | {"lv_pressure": beat["lv_pressure"].shifted(-0.04)} for beat in beats]
    assert self_test(recording, HUMAN, late) > LARGEST


def test_noise_is_the_instruments(recording: Recording, beats: list[dict[str, Curve]]) -> None:
    like, random = data_of(recording), np.random.default_rng(1)
    errors = recorded(like, beats[0], random).values - np.concatenate(
        [beats[0][block.curve](block.times) for block in like.blocks]
    )
    for block, rows in zip(like.blocks, like.rows, strict=True):
        assert np.std(errors[rows]) == pytest.approx(block.noise.middle, rel=0.35)

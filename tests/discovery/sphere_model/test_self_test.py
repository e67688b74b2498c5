"""A nominal heart passes its self-test if the search names no effect in beats without a hidden effect."""

import numpy as np
import pytest

from heartfit.discovery.sphere_model import recentred as module
from heartfit.discovery.sphere_model.forward_model import BASE_COORDINATES, NUMERICS
from heartfit.discovery.sphere_model.nominal_heart import ADULT, perturb
from heartfit.discovery.sphere_model.recentred import SELF_TEST_LIMIT, recorded, self_test
from heartfit.discovery.sphere_model.recording import Recording, search_data
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve

pytestmark = pytest.mark.usefixtures("coarse_search")
POINTS = np.random.default_rng(0).normal(0.0, 0.7, (3, len(BASE_COORDINATES)))
NAMES = ("CatheterDelay", "CatheterOffset", "ImageTriggerDelay")


def curves(x: np.ndarray) -> dict[str, Curve]:
    return beat_curves(perturb(ADULT, x).beat(NUMERICS))


@pytest.fixture(scope="module")
def beats() -> list[dict[str, Curve]]:
    return [curves(x) for x in POINTS]


@pytest.fixture(scope="module")
def recording(beats: list[dict[str, Curve]]) -> Recording:
    shown = {
        "lv_volume": beats[0]["lv_volume"].resampled(28),
        "lv_pressure": beats[0]["lv_pressure"].resampled(86),
    }
    return Recording.from_curves(shown)


@pytest.fixture(autouse=True)
def _few(monkeypatch: pytest.MonkeyPatch) -> None:
    all_candidates = module.candidates
    monkeypatch.setattr(
        module, "candidates", lambda model: {name: all_candidates(model)[name] for name in NAMES}
    )


def test_no_effect_is_found_in_beats_of_the_sphere_model(
    recording: Recording, beats: list[dict[str, Curve]]
) -> None:
    assert self_test(recording, ADULT, beats) < SELF_TEST_LIMIT


def test_a_nominal_heart_with_an_early_pressure_fails(
    recording: Recording, beats: list[dict[str, Curve]]
) -> None:
    late = [beat | {"lv_pressure": beat["lv_pressure"].shifted(-0.04)} for beat in beats]
    assert self_test(recording, ADULT, late) > SELF_TEST_LIMIT


def test_noise_is_the_instruments(recording: Recording, beats: list[dict[str, Curve]]) -> None:
    like, random = search_data(recording), np.random.default_rng(1)
    errors = recorded(like, beats[0], random).values - np.concatenate(
        [beats[0][block.curve](block.times) for block in like.blocks]
    )
    for block, rows in zip(like.blocks, like.rows, strict=True):
        assert np.std(errors[rows]) == pytest.approx(block.noise.middle, rel=0.35)

"""Draws of a planted case: implausible ones are refused, counted and drawn anew, and the answer is not printed."""

from types import SimpleNamespace

import numpy as np
import pytest

from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.observation.curve import Curve
from heartfit.synthetic import case as module
from heartfit.synthetic.campaign import Effect, Inadmissible, draw_effect, effects_of
from heartfit.synthetic.case import (
    Answer,
    PlantedCase,
    draw_admissible,
    require_plausible,
    require_plausible_right,
    require_recordable,
)

TIMES = np.arange(25) * 0.8 / 25
WAVE = np.cos(2.0 * np.pi * TIMES / 0.8)


def beat(filled=150e-6, emptied=60e-6, peak=16e3, drift=1e-4, completed=True):
    volume = 0.5 * (filled + emptied) + 0.5 * (filled - emptied) * WAVE
    return SimpleNamespace(
        completed=completed,
        diagnostics={"drift": drift},
        volume={"lv": volume},
        pressure={"lv": np.linspace(1e3, peak, 25)},
    )


def test_a_plausible_beat_is_taken_as_it_is():
    plausible = beat()
    assert require_plausible(plausible, 1e-3) is plausible


@pytest.mark.parametrize(
    ("implausible", "reason"),
    [
        (beat(completed=False), "no beat"),
        (beat(drift=2e-3), "not periodic"),
        (beat(filled=75e-6, emptied=30e-6), "end-diastolic volume"),
        (beat(filled=310e-6, emptied=120e-6), "end-diastolic volume"),
        (beat(emptied=25e-6), "ejection fraction"),
        (beat(emptied=130e-6), "ejection fraction"),
        (beat(peak=7e3), "peak pressure"),
        (beat(peak=31e3), "peak pressure"),
    ],
)
def test_an_implausible_beat_is_refused_with_its_reason(implausible, reason):
    with pytest.raises(Inadmissible, match=reason):
        require_plausible(implausible, 1e-3)


def test_a_right_ventricle_that_empties_almost_completely_is_refused():
    volume = 80e-6 + 70e-6 * WAVE
    with pytest.raises(Inadmissible, match="right ejection fraction"):
        require_plausible_right(SimpleNamespace(volume={"lv": 0.7 * volume, "rv": volume}))
    require_plausible_right(SimpleNamespace(volume={"lv": volume, "rv": volume + 40e-6}))


def test_a_pressure_that_no_reader_accepts_is_refused():
    low, high = module.PRESSURE_RANGE
    volume = Curve(TIMES, 1e-4 + 4e-5 * WAVE, 0.8)
    sound = {"rest": {"lv_volume": volume, "lv_pressure": Curve(TIMES, np.linspace(low, high, 25), 0.8)}}
    require_recordable(sound)
    for values in (np.linspace(low - 1.0, high, 25), np.linspace(low, high + 1.0, 25)):
        with pytest.raises(Inadmissible, match="recorded pressure"):
            require_recordable({"rest": {"lv_volume": volume, "lv_pressure": Curve(TIMES, values, 0.8)}})


def test_refused_draws_are_counted_by_reason_and_drawn_anew():
    drawn = []

    def draw(rng, rejected):
        drawn.append(rng.standard_normal())
        if len(drawn) < 4:
            raise Inadmissible("no beat" if len(drawn) < 3 else "not periodic")
        return dict(rejected)

    assert draw_admissible(7, draw) == {"no beat": 2, "not periodic": 1}
    assert len(set(drawn)) == 4, "every draw has other random numbers"
    first = list(drawn)
    drawn.clear()
    draw_admissible(7, draw)
    assert drawn == first, "and the seed determines them"


@pytest.mark.parametrize("scales", [1.0, 2.5])
def test_an_effect_is_planted_at_its_size_and_written_into_the_answer(scales):
    planted = draw_effect(MitralRegurgitation, scales, np.random.default_rng(0))
    assert planted.area == pytest.approx(scales * MitralRegurgitation.switch().scale)
    (effect,) = effects_of([planted], scales)
    assert effect == Effect("MitralRegurgitation", planted.area, 0.0, "m^2", scales, effect.others)


def test_a_case_is_printed_without_its_answer():
    effect = Effect("MitralRegurgitation", 3e-5, 0.0, "m^2", 2.0)
    planted = PlantedCase({}, Answer(7, "single", (effect,), {}, {}, 0.02))
    assert "Regurgitation" not in repr(planted)

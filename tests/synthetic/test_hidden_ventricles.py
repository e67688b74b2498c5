"""Hidden hearts of both ventricles pump the same volume on both sides, with any effect."""

import numpy as np
import pytest

from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.mechanisms.pulmonary_regurgitation import PulmonaryRegurgitation
from heartfit.mechanisms.tricuspid_regurgitation import TricuspidRegurgitation
from heartfit.observation.beat import beat_curves
from heartfit.roles import Mechanism
from heartfit.roles.sides import net_inflow
from heartfit.synthetic.hidden import RecordingProtocol
from heartfit.synthetic.hidden_ventricles import HiddenVentricles, draw_ventricles

EFFECTS: tuple[tuple[Mechanism, ...], ...] = (
    (),
    (MitralRegurgitation(0.2e-4),),
    (TricuspidRegurgitation(0.5e-4),),
)


def drawn(seed: int) -> HiddenVentricles:
    return draw_ventricles(np.random.default_rng(seed))


@pytest.mark.parametrize("effects", EFFECTS, ids=("sound", "mitral", "tricuspid"))
@pytest.mark.parametrize("seed", range(2))
def test_both_sides_pump_the_same_volume(seed: int, effects: tuple[Mechanism, ...]) -> None:
    heart = drawn(seed).with_effects(effects)
    beat = heart.beat()
    inflow = net_inflow(beat.flow, heart.left.heart.mechanisms)
    out_of_the_atrium, into_the_lung = -inflow["left_atrium"], inflow["pulmonary_artery"]
    assert into_the_lung * beat.period == pytest.approx(out_of_the_atrium * beat.period, abs=0.1e-6)
    assert 60e-6 < beat.volume["rv"].max() < 350e-6


def test_behind_a_leaking_pulmonary_valve_the_right_ventricle_is_wider() -> None:
    sound, ill = (
        drawn(1).with_effects(effects).beat() for effects in ((), (PulmonaryRegurgitation(0.4e-4),))
    )
    assert ill.volume["rv"].max() > sound.volume["rv"].max() + 10e-6
    assert ill.volume["lv"] == pytest.approx(sound.volume["lv"], abs=5e-8)


def test_the_right_volume_is_shown_with_its_gain() -> None:
    heart, rng = drawn(0), np.random.default_rng(5)
    shown = heart.measure(RecordingProtocol(28, 0.001, catheter=0.1), rng)
    true = beat_curves(heart.beat())["rv_volume"]
    ratio = shown["rv_volume"].values / true(shown["rv_volume"].times)
    assert shown.keys() == {"lv_volume", "lv_pressure", "rv_volume"}
    assert np.median(ratio) == pytest.approx(heart.gain, abs=0.01)
    assert abs(heart.gain - 1.0) > 0.02


def test_a_right_catheter_measures_the_right_pressure() -> None:
    heart, rng = drawn(0), np.random.default_rng(5)
    shown = heart.measure(RecordingProtocol(28, 0.001, catheter=0.1), rng, right_catheter=True)["rv_pressure"]
    true = beat_curves(heart.beat())["rv_pressure"]
    assert shown.values == pytest.approx(true(shown.times), abs=250.0)
    assert np.std(shown.values - true(shown.times)) < 80.0

"""Hidden hearts: plausible, of another model than the diagnoser's, and reproducible by their seed."""

import numpy as np
import pytest

from heartfit.heart.circulation.elements import OrificeValve
from heartfit.heart.simulation import Numerics
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.synthetic.hidden import NUMERICS, SIZE, draw_hidden

HEARTS = [draw_hidden(np.random.default_rng(seed)) for seed in range(24)]


def test_a_seed_draws_the_same_heart_and_another_one_another():
    again = draw_hidden(np.random.default_rng(3))
    assert again.heart == HEARTS[3].heart
    assert again.sphere == HEARTS[3].sphere
    assert HEARTS[4].heart != HEARTS[3].heart


def test_the_hidden_heart_shares_neither_integrator_nor_valves_nor_inertia_nor_length_dependence():
    standard = Numerics()
    for hidden in HEARTS:
        assert (NUMERICS.second_order, NUMERICS.time_step) != (standard.second_order, standard.time_step)
        assert isinstance(hidden.heart.circulation.aortic, OrificeValve)
        assert hidden.inertia.density > 0.0
        assert all(value > 0.0 for _, value in hidden.inertia.valves)
        assert 0.1 < hidden.heart.tissue.active.starling.slope < 0.6
        assert not np.array_equal(hidden.activation, HEARTS[0].activation) or hidden is HEARTS[0]


def test_the_average_heart_is_that_of_an_adult():
    beats = [hidden.beat() for hidden in HEARTS]
    assert all(beat.completed and beat.diagnostics["drift"] < NUMERICS.drift for beat in beats)
    filled = np.array([beat.volume["lv"].max() for beat in beats])
    emptied = np.array([beat.volume["lv"].min() for beat in beats])
    peak = np.array([beat.pressure["lv"].max() for beat in beats])
    assert np.median(filled) == pytest.approx(150e-6, abs=15e-6)
    assert np.median(emptied) == pytest.approx(60e-6, abs=15e-6)
    assert np.median(peak) == pytest.approx(15e3, abs=1.5e3)


def test_deviates_are_standard_normal_but_cut_off():
    deviates = np.array([list(hidden.deviates.values()) for hidden in HEARTS])
    assert deviates.shape == (24, 19)
    assert abs(deviates.mean()) < 4.0 / np.sqrt(deviates.size)
    assert deviates.std() == pytest.approx(1.0, abs=4.0 / np.sqrt(2.0 * deviates.size))


def test_size_changes_no_pressure(monkeypatch):
    def beat_of(size):
        monkeypatch.setattr("heartfit.synthetic.hidden.SIZE", SIZE if size else 0.0)
        return draw_hidden(np.random.default_rng(0)).beat()

    other, same = beat_of(True), beat_of(False)
    larger = other.volume["lv"] / same.volume["lv"]
    assert np.ptp(larger) < 0.02
    assert larger.mean() == pytest.approx(np.exp(SIZE * _size_deviate()), rel=0.02)
    assert np.abs(other.pressure["lv"] - same.pressure["lv"]).max() < 200.0


def _size_deviate():
    rng = np.random.default_rng(0)
    return rng.standard_normal(20)[19]


def test_an_effect_changes_the_beat_and_a_load_fills_the_heart():
    leaking = HEARTS[0].with_effects([MitralRegurgitation(area=0.3e-4)])
    assert leaking.beat().flow["MitralRegurgitation"].max() > 1e-5
    assert HEARTS[0].with_preload(1.5).beat().volume["lv"].max() > HEARTS[0].beat().volume["lv"].max() + 2e-6

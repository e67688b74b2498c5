"""Planted cases: the requested effects, reproducible by their seed, in plausible patients only."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.heart.heart import Heart
from heartfit.roles import registered
from heartfit.synthetic import case as cases
from heartfit.synthetic.campaign import (
    Inadmissible,
    PlantedPlan,
    PlantingCampaign,
    Reloaded,
    draw_effect,
    plantable,
)
from heartfit.synthetic.case import draw_effects, plant
from heartfit.synthetic.hidden import draw_hidden
from heartfit.synthetic.out_of_library import OUT_OF_LIBRARY, add_effect

LEAK = PlantedPlan(7, "single", ("MitralRegurgitation",), 2.0)


def values(planted, curve="lv_volume"):
    return planted.curves["rest"][curve].values


def test_a_plan_gives_the_same_case_and_another_seed_another():
    assert np.array_equal(values(plant(LEAK)), values(plant(LEAK)))
    other = plant(PlantedPlan(8, "single", LEAK.names, 2.0))
    assert not np.array_equal(values(other)[:20], values(plant(LEAK))[:20])


def test_the_answer_holds_the_planted_effect_and_the_curves_do_not():
    planted = plant(LEAK)
    (effect,) = planted.answer.effects
    switch = registered()["MitralRegurgitation"].switch()
    assert (effect.name, effect.unit, effect.scales) == ("MitralRegurgitation", "m^2", 2.0)
    assert effect.amplitude == pytest.approx(2.0 * switch.scale)
    assert set(planted.curves) == {"rest"}
    assert set(planted.curves["rest"]) == {"lv_volume", "lv_pressure"}
    assert "Regurgitation" not in repr(planted)


def test_a_second_condition_is_the_same_heart_fuller():
    planted = plant(PlantedPlan(7, "none", reloaded=True))
    rest, fuller = (planted.curves[name]["lv_volume"].values.max() for name in ("rest", "legs_raised"))
    assert fuller > rest


def test_the_recording_at_rest_does_not_know_of_another_condition():
    assert np.array_equal(values(plant(replace(LEAK, reloaded=True))), values(plant(LEAK)))


def test_an_unreadable_pressure_is_redrawn(monkeypatch):
    calm = plant(PlantedPlan(8, "none"))
    lowest = values(calm, "lv_pressure").min()
    monkeypatch.setattr(cases, "PRESSURE_RANGE", (lowest + 1.0, 40e3))
    again = plant(PlantedPlan(8, "none"))
    assert again.answer.rejected["recorded pressure"] >= 1
    assert values(again, "lv_pressure").min() > lowest


@pytest.mark.parametrize("name", plantable())
def test_every_mechanism_of_the_registry_can_be_planted(name):
    effect = draw_effect(plantable()[name], 2.0, np.random.default_rng(0))
    assert abs(getattr(effect, effect.switch().name) - effect.switch().off) > 0.0


def test_effects_of_the_right_side_need_a_heart_of_two_sides():
    right = plantable(sides=2).keys() - plantable().keys()
    assert {"TricuspidRegurgitation", "PulmonaryStenosis", "LateRightWall"} <= right
    for name in right:
        plan = PlantedPlan(7, "single", (name,), 2.0)
        (drawn,) = draw_effects(plan, np.random.default_rng(0), sides=2)
        assert type(drawn).__name__ == name
        with pytest.raises(KeyError):
            draw_effects(plan, np.random.default_rng(0))


def test_both_signs_are_drawn_where_there_are_two():
    drawn = [
        draw_effect(plantable()["ImageTriggerDelay"], 2.0, np.random.default_rng(seed)).delay
        for seed in range(20)
    ]
    assert min(drawn) < 0.0 < max(drawn)
    leaks = [
        draw_effect(plantable()["MitralRegurgitation"], 2.0, np.random.default_rng(s)) for s in range(20)
    ]
    assert min(leak.area for leak in leaks) > 0.0


def test_the_atrial_kick_is_not_planted():
    assert "AtrialKick" not in plantable()


@pytest.mark.parametrize("effect", OUT_OF_LIBRARY, ids=lambda cls: cls.__name__)
def test_an_out_of_library_effect_is_not_registered_and_is_observable(effect):
    assert effect.__name__ not in registered()
    without = plant(PlantedPlan(3, "none"))
    planted = plant(PlantedPlan(3, "outside", (effect.__name__,), 2.5))
    change = max(
        np.ptp(values(planted, c)) / np.ptp(values(without, c)) for c in ("lv_volume", "lv_pressure")
    )
    assert planted.answer.effects[0].name == effect.__name__
    assert np.isfinite(change)


@pytest.mark.parametrize("effect", OUT_OF_LIBRARY, ids=lambda cls: cls.__name__)
def test_an_out_of_library_effect_that_is_off_changes_no_bit_of_a_heart(effect):
    hidden = draw_hidden(np.random.default_rng(2))
    off = effect().turned_off()
    beat = hidden.with_effects([off]).beat()
    assert np.allclose(beat.volume["lv"], hidden.beat().volume["lv"], rtol=1e-9)
    if "lv_volume" in getattr(off, "measures", ()):
        assert np.array_equal(off.distort(beat.time, beat.volume["lv"], beat.period), beat.volume["lv"])


def test_a_second_twitch_is_a_second_share_of_the_depolarisation():
    control = add_effect(Heart(), OUT_OF_LIBRARY[-1](share=0.4)).tissue.control
    start = np.linspace(0.0, 0.8, 801)
    _, attach = control.mean(start, 1e-3, np.zeros(1), 0.829)
    second = attach[(start > 0.625) & (start < 0.71)]
    assert np.allclose(second, 0.4 * control.k_ATP)


def test_implausible_hearts_are_counted_and_redrawn(monkeypatch):
    monkeypatch.setattr(cases, "EJECTION_FRACTION", (0.55, 0.8))
    planted = [plant(PlantedPlan(seed, "none")) for seed in range(6)]
    assert sum(case.answer.rejected.get("ejection fraction", 0) for case in planted) > 0
    fractions = [1.0 - values(case).min() / values(case).max() for case in planted]
    assert min(fractions) > 0.5


def test_a_seed_that_never_gives_a_patient_is_reported(monkeypatch):
    monkeypatch.setattr(cases, "PEAK", (0.0, 1.0))
    monkeypatch.setattr(cases, "ATTEMPTS", 3)
    with pytest.raises(RuntimeError, match=r"seed 1\b.*\b3\b"):
        plant(PlantedPlan(1, "none"))


def test_a_mechanism_that_refuses_its_draw_is_inadmissible():
    shrinkage = plantable()["ImageShrinkage"]
    with pytest.raises(Inadmissible):
        draw_effect(shrinkage, 1e3, np.random.default_rng(0))


def test_a_campaign_plants_its_declared_cases_each_with_its_seed():
    plans = PlantingCampaign(1000, 4, 2, 1, 3, (2.0, 2.5), 2.5).plans(("A", "B", "C"), ("X",))
    kinds = [plan.kind for plan in plans]
    assert {kind: kinds.count(kind) for kind in set(kinds)} == {
        "none": 4,
        "single": 12,
        "outside": 2,
        "two": 3,
    }
    assert [plan.seed for plan in plans] == list(range(1000, 1021))
    assert kinds != sorted(kinds)
    assert all(len(set(plan.names)) == 2 for plan in plans if plan.kind == "two")


def test_some_nulls_and_singles_of_one_size_are_measured_under_another_loading_too():
    plans = PlantingCampaign(1000, 4, 2, 1, 3, (2.0, 2.5), 2.5, Reloaded(3, 5, 2.0)).plans(
        ("A", "B", "C"), ("X",)
    )
    marked = [plan for plan in plans if plan.reloaded]
    assert [plan.kind for plan in marked].count("none") == 3
    assert [plan.scales for plan in marked if plan.kind == "single"] == [2.0] * 5
    assert len(marked) == 8


def test_the_first_cases_are_those_of_the_whole_campaign():
    campaign = PlantingCampaign(1000, 30, 1, 1, 4, (2.0,), 2.5)
    (first, second, *_), (few,) = campaign.batches(3), campaign.batches(3, first=3)
    assert few == first
    assert [plan.seed for plan in first + second] == list(range(1000, 1006))

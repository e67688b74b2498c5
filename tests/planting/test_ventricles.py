"""Effects hidden in three dimensions: what is planted, from its seed, in a wall that the case hands on."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.cohort.protocol import Protocol
from heartfit.cohort.template import Template
from heartfit.io.configuration import read_study
from heartfit.planting import ventricles
from heartfit.planting.campaign import Plan
from heartfit.planting.ventricles import Ventricles
from heartfit.simulation import Numerics

CONFIG = Path(__file__).parents[2] / "config"
COARSE = Numerics(time_step=0.02, max_beats=1, drift=1.0)
LEAK = Plan(5, "single", ("MitralRegurgitation",), 3.0)


@pytest.fixture(scope="module")
def hidden():
    return Ventricles(Template.build(0.02, 0.0015), {"sigma_0": 257e3}, Protocol(COARSE, (1300.0, 520.0)))


def volumes(case):
    return case.curves["rest"]["lv_volume"].values


def test_a_leak_is_planted_in_the_heart_of_the_seed(hidden):
    wall, leaking = hidden.plant(LEAK)
    same, sound = hidden.plant(Plan(5, "none"))
    assert wall.points.shape == same.points.shape
    assert leaking.answer.truth == sound.answer.truth
    (effect,) = leaking.answer.effects
    assert (effect.name, effect.scales) == ("MitralRegurgitation", 3.0)
    assert np.ptp(volumes(leaking)) > np.ptp(volumes(sound))
    assert set(leaking.curves["rest"]) == {"lv_volume", "lv_pressure"}


def test_a_seed_gives_one_case(hidden):
    first, again = (hidden.plant(Plan(6, "none"))[1] for _ in range(2))
    assert np.array_equal(volumes(first), volumes(again))


def test_a_heart_that_does_not_beat_is_counted_and_drawn_anew(hidden, monkeypatch):
    beat, calls = ventricles.generate, []

    def failing_once(*given):
        calls.append(given)
        if len(calls) == 1:
            raise ventricles.VolunteerError("no beat")
        return beat(*given)

    monkeypatch.setattr(ventricles, "generate", failing_once)
    _, case = hidden.plant(Plan(5, "none"))
    assert case.answer.rejected == {"no beat": 1}


def test_the_study_hides_what_the_project_set_itself():
    plans = read_study([CONFIG / "config.yaml"]).discovery_benchmark.ventricles.plans()
    assert sum(plan.kind == "single" for plan in plans) >= 20
    assert sum(plan.kind == "none" for plan in plans) >= 5
    assert len({plan.seed for plan in plans}) == len(plans)

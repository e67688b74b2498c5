"""A planted case records the heart with its effects, at rest and with raised legs; hearts are stand-ins."""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest

from heartfit.observation.curve import Curve
from heartfit.synthetic import case as module
from heartfit.synthetic.campaign import PlantedPlan, mechanism_of
from heartfit.synthetic.case import PRELOAD, plant
from heartfit.synthetic.misspecified import Misspecification

TIMES = np.arange(25) * 0.8 / 25
WAVE = np.cos(2.0 * np.pi * TIMES / 0.8)
REST = 1e3
"""Filling pressure of every heart at rest [Pa]."""


@dataclass(frozen=True)
class StandIn:
    """Stand-in for a hidden heart, whose volume grows with its filling pressure and with each of its effects."""

    effects: tuple = ()
    filling: float = REST
    deviates: tuple = ()

    @property
    def heart(self):
        return SimpleNamespace(sensors=())

    def with_effects(self, effects):
        return replace(self, effects=(*self.effects, *effects))

    def with_preload(self, factor):
        return replace(self, filling=factor * self.filling)

    def beat(self):
        return self


def measured(heart, *_):
    leak = sum(effect.area for effect in heart.effects)
    volume = 1e-4 * heart.filling / REST * (1.0 + 0.3 * WAVE) + leak
    return {"lv_volume": Curve(TIMES, volume, 0.8), "lv_pressure": Curve(TIMES, 8e3 - 7e3 * WAVE, 0.8)}


@pytest.fixture(autouse=True)
def _hearts(monkeypatch):
    monkeypatch.setattr(Misspecification, "draw_heart", lambda *_: StandIn())
    monkeypatch.setattr(module, "measure_beat", measured)
    monkeypatch.setattr(module, "require_plausible", lambda beat, _: beat)


@pytest.mark.parametrize("scales", [1.0, 2.5])
def test_the_recorded_heart_has_the_effect_of_the_answer(scales):
    planted = plant(PlantedPlan(3, "single", ("MitralRegurgitation",), scales))
    (effect,) = planted.answer.effects
    sound = measured(StandIn())["lv_volume"].values
    assert planted.curves["rest"]["lv_volume"].values - sound == pytest.approx(effect.amplitude)
    assert mechanism_of(effect).switch().at(effect.scales) == pytest.approx(effect.amplitude)
    assert effect.amplitude > 0.0


def test_raised_legs_fill_the_same_heart_with_its_effects():
    ratios = []
    for seed in range(20):
        planted = plant(PlantedPlan(seed, "single", ("MitralRegurgitation",), 2.0, reloaded=True))
        rest, raised = (planted.curves[name]["lv_volume"].values for name in ("rest", "legs_raised"))
        leak = planted.answer.effects[0].amplitude
        share = (raised - leak) / (rest - leak)
        assert np.ptp(share) < 1e-9
        ratios.append(share.mean())
    assert PRELOAD[0] <= min(ratios) < max(ratios) <= PRELOAD[1]
    assert len(set(ratios)) == 20

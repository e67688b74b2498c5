"""Hidden effects of sealed hearts: drawn by the seed alone, visible, on the heart, and restored from their seal."""

import pytest

from heartfit.discovery.inference.decide import CENTRED_RULES
from heartfit.io.seals import open_effects, seal
from heartfit.roles import Sensor, registered
from heartfit.synthetic import sealed
from heartfit.synthetic.campaign import DRAWN, effects_of, mechanism_of
from heartfit.synthetic.sealed import MARGIN, SIZES, draw_visible_effect, hidden_effects, is_visible

SEEDS = range(40)


@pytest.fixture
def all_visible(monkeypatch):
    monkeypatch.setattr(sealed, "is_visible", lambda effect, scales: True)


@pytest.mark.usefixtures("all_visible")
def test_the_seed_alone_decides_and_different_seeds_hide_different_effects():
    drawn = [draw_visible_effect(seed) for seed in SEEDS]
    assert drawn == [draw_visible_effect(seed) for seed in SEEDS]
    assert len({effect.name for effect in drawn}) > 8
    assert all(SIZES[0] <= effect.scales <= SIZES[1] for effect in drawn)
    assert not [effect for effect in drawn if issubclass(registered()[effect.name], Sensor)]


def test_an_effect_is_drawn_again_until_it_can_be_seen(monkeypatch):
    shown = []
    monkeypatch.setattr(sealed, "is_visible", lambda effect, _: shown.append(effect) or len(shown) == 4)
    drawn = draw_visible_effect(1)
    assert len(shown) == 4
    assert mechanism_of(drawn) == shown[-1]


@pytest.mark.parametrize(
    ("size", "visible"), [(1.05 * MARGIN, True), (0.95 * MARGIN, False), (-1.05 * MARGIN, False)]
)
def test_an_effect_is_visible_if_half_of_it_with_its_sign_reaches_the_threshold(monkeypatch, size, visible):
    """A delay of one scale reaches the threshold; an advance, which the heart would absorb, shows nothing."""
    monkeypatch.setattr(
        sealed, "expected_evidence", lambda _, scales: CENTRED_RULES.detected * max(scales, 0.0) ** 2
    )
    (delay,) = hidden_effects("ImageTriggerDelay", size, 0)
    assert is_visible(mechanism_of(delay), abs(size)) is visible


def test_a_stenosis_is_visible_and_a_stiffening_is_not_at_any_size():
    stenosis, stiffening = (
        mechanism_of(hidden_effects(name, 3.0, 0)[0]) for name in ("AorticStenosis", "FibreStiffening")
    )
    assert is_visible(stenosis, 3.0)
    assert not is_visible(stenosis, 0.1 * MARGIN)
    assert not is_visible(stiffening, SIZES[1])


def test_a_named_effect_has_its_size_and_a_sound_heart_none():
    (effect,) = hidden_effects("MitralRegurgitation", 3.0, 0)
    switch = registered()["MitralRegurgitation"].switch()
    assert (effect.amplitude, effect.scales) == (switch.at(3.0), 3.0)
    assert hidden_effects(None, 0.0, 0) == ()


@pytest.mark.usefixtures("all_visible")
@pytest.mark.parametrize("seed", range(6))
def test_a_seal_restores_the_mechanism_with_all_its_values(tmp_path, seed):
    effects = hidden_effects(DRAWN, 0.0, seed)
    seal(tmp_path / "effects.sealed", effects)
    assert effects[0].name not in (tmp_path / "effects.sealed").read_text()
    (restored,) = open_effects([tmp_path / "effects.sealed"])
    assert restored == effects[0]
    assert effects_of([mechanism_of(restored)], restored.scales) == effects


def test_no_seal_is_no_effect():
    assert open_effects([]) == []

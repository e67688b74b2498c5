"""The card of a wall says what is missing, how large it is, and where."""

import pytest

from heartfit.discovery.inference.decide import Decision
from heartfit.mechanisms.scar import Scar
from heartfit.results.wall_card import NAMES, wall_card
from tests.discovery.wall_model.test_search import searched


def test_a_scar_is_told_by_its_share_and_segments() -> None:
    card = wall_card(searched([Scar(extent=0.24, angle=1.05)], 11), "The wall")
    sentence = card.splitlines()[2]
    assert sentence.startswith("Missing mechanism: scar, scarred share of the left ventricle 0.2")
    assert "mid anterior" in sentence
    assert "infero" not in sentence
    assert "| scar |" in card
    assert "| 7 | mid anterior |" in card


@pytest.mark.parametrize("seed", [0, 1])
def test_a_sound_wall_has_no_segments(seed: int) -> None:
    card = wall_card(searched([], seed), "The wall")
    assert "No missing mechanism detected" in card
    assert "segment" not in card


def test_every_segment_has_its_name() -> None:
    assert NAMES[0] == "basal anterior"
    assert NAMES[8] == "mid inferoseptal"
    assert NAMES[16] == "apex"
    assert len(NAMES) == 17
    assert Decision("none").effects == ()

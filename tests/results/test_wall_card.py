"""The card of a wall says what is missing, how large it is, and where."""

from dataclasses import replace

import pytest

from heartfit.discovery.inference.decide import Decision
from heartfit.mechanisms.scar import Scar
from heartfit.results.wall_card import wall_card, wall_figure
from heartfit.results.wall_summary import NAMES, summarise_wall
from tests.discovery.wall_model.test_search import searched


def test_a_scar_is_told_by_its_share_and_segments() -> None:
    card = wall_card(summarise_wall(searched(Scar(extent=0.24, angle=1.05), 11), "The wall"))
    sentence = card.splitlines()[2]
    assert sentence.startswith("Missing mechanism: scar, scarred share of the left ventricle 0.2")
    assert "mid anterior" in sentence
    assert "infero" not in sentence
    assert "threshold 10)" in sentence
    assert "| scar |" in card
    assert "| 7 | mid anterior |" in card
    assert "| scar | scarred share" not in card
    assert "| delayed activation | delay of" in card


@pytest.mark.parametrize("seed", [0, 1])
def test_a_sound_wall_has_no_segments(seed: int) -> None:
    summary = summarise_wall(searched(None, seed), "The wall")
    card = wall_card(summary)
    assert "No missing mechanism detected" in card
    assert "| segment |" not in card
    largest = max(summary.evidence.values())
    assert f"the largest ln Bayes factor is {largest:.1f}, the threshold is 10." in summary.sentence
    assert "ln Bayes factor (threshold 10)" in card
    unseen = {one.name: one.most_visible for one in summary.unseen}
    assert set(unseen) == {"scar", "delayed activation"}
    assert 0.05 < float(unseen["scar"]) < 0.3
    assert f"| {unseen['scar']} |" in card


def test_a_figure_needs_an_effect_of_a_region() -> None:
    scarred = summarise_wall(searched(Scar(extent=0.24, angle=1.05), 11), "The wall")
    figure = wall_figure(scarred)
    assert figure is not None
    assert figure.axes[0].get_title() == "scar"
    assert wall_figure(replace(scarred, effect="", probability=[])) is None


def test_every_segment_has_its_name() -> None:
    assert NAMES[0] == "basal anterior"
    assert NAMES[8] == "mid inferoseptal"
    assert NAMES[16] == "apex"
    assert len(NAMES) == 17
    assert Decision("none").effects == ()

"""Cards: prior and posterior, information of the data, and coverage of the truth."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.results.card import POOLED, cards, cards_table, coverage_table
from heartfit.results.card_figure import plot_card, plot_cards
from heartfit.results.colours import SETTING_COLOURS

COLOUR = SETTING_COLOURS[0]


def test_a_card_has_places_and_coverage_in_prior_deviations(cohort):
    volunteer = cohort[0]
    assert volunteer.true_place()[3] == pytest.approx(np.log(0.9 * 0.8) / 0.25)
    assert set(volunteer.covered(volunteer.noise_aware.estimate)) == {"sigma_0", "mu", "c_1", "R_p"}
    far = replace(volunteer, truth={"sigma_0": 1e9})
    assert far.covered(far.noise_aware.estimate) == {"sigma_0": False}
    assert volunteer.information.rank == 3
    assert volunteer.weakest() == "R_p up with sigma_0 up"


@pytest.mark.parametrize(("reach", "held"), [(1.95, True), (1.97, False)])
def test_an_interval_reaches_as_far_as_95_percent_of_its_own_posterior(cohort, reach, held):
    estimate = cohort[0].noise_aware.estimate
    edge = {
        name: np.exp(m + reach * sd)
        for name, m, sd in zip(estimate.names, estimate.mean, estimate.sd, strict=True)
    }
    assert set(replace(cohort[0], truth=edge).covered(estimate).values()) == {held}


def test_the_table_has_a_row_per_parameter_and_no_verdict_without_a_truth(cohort):
    table = cards_table(cohort).set_index(["case", "parameter"])
    assert len(table) == 5 * 4 + 2 * 7
    assert (table.loc["real", "noise-aware covered"] == "").all()
    assert table.loc["real", "truth"].isna().all()
    row = table.loc[("volunteer1", "R_p")]
    assert row["variance reduction"] == pytest.approx(1 - row["noise-aware sd over prior"] ** 2)
    assert row["noise-free sd over prior"] <= row["noise-aware sd over prior"] < 1
    assert row["rank"] == "3 of 4"


def test_a_long_step_names_the_posteriors_that_took_it(cohort):
    card = cohort[0]
    place = card.noise_free.estimate.mean.copy()
    place[0] = card.prior.mean[0] + 2.6 * card.prior.sd[0]
    far = replace(
        card, noise_free=replace(card.noise_free, estimate=replace(card.noise_free.estimate, mean=place))
    )
    flags = cards_table([far]).set_index("parameter")["long steps"]
    assert flags.tolist() == ["noise-free", "", "", ""]
    assert "†" in plot_card(far, COLOUR).axes[0].get_yticklabels()[0].get_text()
    assert "†" not in plot_card(card, COLOUR).axes[0].get_yticklabels()[0].get_text()


def test_coverage_counts_hearts_with_a_truth(cohort):
    wrong = [
        replace(card, truth={name: 1e3 * value for name, value in card.truth.items()}) for card in cohort[:2]
    ]
    table = coverage_table([*wrong, *cohort[2:]]).set_index(["posterior", "parameter"])
    row = table.loc[("noise-aware", POOLED)]
    assert row["hearts"] == 6, "the measured heart has no truth"
    assert row["covered (%)"] == pytest.approx(100 * 4 / 6, abs=0.1)
    assert row["from (%)"] < row["covered (%)"] < row["to (%)"]
    assert table.loc[("noise-aware", "tau"), "hearts"] == 2


def test_no_estimate_is_held_against_a_true_K():
    table = cards([("v", "locking")], [None], [None], {"v": {"K": 1.0, "mu": 2.0}})  # type: ignore[list-item]
    assert table[0].truth == {"mu": 2.0}


def test_the_figure_shows_each_parameter_and_direction(cohort):
    figure = plot_card(cohort[0], COLOUR)
    left, right = figure.axes
    assert len(right.patches) == 4
    assert [bar.get_width() for bar in right.patches] == pytest.approx(cohort[0].information.reduction)
    prior = left.patches[:4]
    assert [bar.get_width() for bar in prior] == pytest.approx([3.92] * 4)
    truths = {name: 1e3 * value for name, value in cohort[0].truth.items()}
    missed = plot_card(replace(cohort[0], truth=truths), COLOUR).axes[0]
    assert {text.get_text().rsplit(",")[-1] for text in left.texts}.isdisjoint(
        text.get_text().rsplit(",")[-1] for text in missed.texts
    )
    assert "3 of 4" in figure.get_suptitle()


def test_a_truth_beyond_the_edge_is_an_arrow(cohort):
    markers = [
        line.get_marker() for line in plot_card(replace(cohort[0], truth={"mu": 1.0}), COLOUR).axes[0].lines
    ]
    assert "<" in markers


def test_figures_are_named_by_case_and_setting(cohort):
    assert list(plot_cards(cohort[:1], {"physical": COLOUR})) == ["volunteer1_physical_card"]

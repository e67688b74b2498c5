"""Patients are compared with volunteers as far as the data inform."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.results.card import Card
from heartfit.results.case import Groups
from heartfit.results.specificity import PatientComparison, compare_groups
from heartfit.results.specificity_table import (
    ClaimedLimits,
    plot_specificity,
    specificity_claims,
    specificity_table,
)

LIMITS = ClaimedLimits(weak=0.7, stiff=1.4)


@pytest.fixture
def compared(cohort, groups) -> PatientComparison:
    return compare_groups(cohort, groups)[0]


def test_only_what_is_estimated_in_everybody_is_compared(compared):
    assert compared.names == ("sigma_0", "mu", "c_1", "R_p")
    assert [card.case for card in compared.volunteers] == [
        "volunteer1",
        "volunteer2",
        "volunteer3",
        "volunteer4",
    ]


def test_true_ratios_are_those_of_the_cohort(compared):
    healthy = np.mean([1.1, 0.76, 0.95, 1.2])
    assert compared.ratios("truth", "sigma_0")["lbbb2"] == pytest.approx(0.55 / healthy)


def test_the_estimate_without_the_pull_of_the_prior_is_nearer_the_truth(compared):
    error = {
        reading: abs(
            np.log(compared.ratios(reading, "c_1")["lbbb2"] / compared.ratios("truth", "c_1")["lbbb2"])
        )
        for reading in ("noise-aware", "unshrunk")
    }
    assert error["unshrunk"] < error["noise-aware"]


def test_p_cannot_be_below_that_of_one_labeling(compared):
    table = specificity_table([compared])
    assert table["least p"].dropna().unique() == pytest.approx([1 / 15])
    assert (table["p"].dropna() >= 1 / 15 - 1e-12).all()
    sigma = table[(table["parameter"] == "sigma_0") & (table["reading"] == "truth")].iloc[0]
    assert sigma["p"] == pytest.approx(1 / 15)


def test_long_steps_are_named_by_reading_and_never_of_the_truth(cohort, groups):
    def with_contractility_at(card: Card, reach: float) -> Card:
        mean = card.noise_free.estimate.mean.copy()
        mean[0] = card.prior.mean[0] + reach * card.prior.sd[0]
        estimate = replace(card.noise_free.estimate, mean=mean)
        return replace(card, noise_free=replace(card.noise_free, estimate=estimate))

    sick = [with_contractility_at(card, -2.9 if card.case == "lbbb2" else -1.0) for card in cohort]
    compared = compare_groups(sick, groups)
    flags = specificity_table(compared).set_index(["parameter", "reading"])["long steps"]
    assert flags["sigma_0", "noise-free"] == "lbbb2 -2.9"
    assert flags["sigma_0", "truth"] == ""
    claims = specificity_claims(compared, LIMITS).set_index(["claim", "reading"])["long steps"]
    assert claims["sigma_0 of lbbb1 and lbbb2 below", "noise-free"] == "lbbb2 -2.9"


def unseen(card: Card) -> Card:
    """The same estimate with the prior's uncertainty."""
    estimate = replace(card.noise_aware.estimate, covariance=card.prior.covariance)
    return replace(card, noise_aware=replace(card.noise_aware, estimate=estimate))


def test_a_difference_not_informed_by_the_data_has_a_warning(cohort, groups):
    table = specificity_table(compare_groups([unseen(card) for card in cohort], groups))
    assert (table["warning"] != "").all()
    assert table["variance reduction"].dropna().tolist() == pytest.approx([0.0] * 19, abs=1e-9), (
        "no unshrunk information is left"
    )
    informed = specificity_table(compare_groups(cohort, groups))
    assert (informed["warning"] == "").all()


def test_both_claims_hold_for_the_truth_and_one_fails_under_the_prior(compared):
    claims = specificity_claims([compared], LIMITS).set_index(["claim", "reading"])
    weakest = claims.loc[("sigma_0 of lbbb1 and lbbb2 below", "truth"), "over healthy"]
    assert weakest == pytest.approx(compared.ratios("truth", "sigma_0")["lbbb1"]), "the less weak one decides"
    table = claims["holds"]
    assert (table.loc["sigma_0 of lbbb1 and lbbb2 below"] == "holds").all()
    assert table.loc[("c_1 of lbbb2 above", "truth")] == "holds"
    assert table.loc[("c_1 of lbbb2 above", "noise-aware")] == "does not hold"


def test_K_is_compared_with_the_true_stiffness(cohort, groups):
    def renamed(card: Card) -> Card:
        names = tuple("K" if name == "c_1" else name for name in card.prior.names)
        noise_free, noise_aware = (
            replace(one, prior=replace(one.prior, names=names), estimate=replace(one.estimate, names=names))
            for one in (card.noise_free, card.noise_aware)
        )
        return replace(card, noise_free=noise_free, noise_aware=noise_aware)

    comparison = compare_groups([renamed(card) for card in cohort], groups)[0]
    assert comparison.ratios("truth", "K") == pytest.approx(
        compare_groups(cohort, groups)[0].ratios("truth", "c_1")
    )
    assert "K of lbbb2 above" in specificity_claims([comparison], LIMITS)["claim"].tolist()


def test_one_patient_and_one_volunteer_are_compared_as_well(cohort, groups):
    small = compare_groups(cohort, Groups(groups.volunteers[:1], (), groups.patients[:1]))
    assert specificity_table(small)["least p"].dropna().unique() == pytest.approx([0.5])
    assert compare_groups(cohort, Groups(groups.volunteers)) == []
    assert specificity_table([]).empty


def test_the_figure_has_a_panel_per_parameter_and_grey_where_the_data_are_uninformative(
    cohort, groups, compared
):
    figure = plot_specificity([compared], LIMITS)
    assert sum(axes.get_visible() for axes in figure.axes) == 4
    assert {axes.get_facecolor()[0] for axes in figure.axes} == {1.0}
    grey = plot_specificity(compare_groups([unseen(card) for card in cohort], groups), LIMITS)
    assert all(axes.get_facecolor()[0] < 1.0 for axes in grey.axes)
    assert plot_specificity([], LIMITS).axes

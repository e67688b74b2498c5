"""Verdicts on hidden effects, printed, drawn and held to claims."""

from dataclasses import replace

import pandas as pd
import pytest

from heartfit.discovery.sphere_model.cause import Cause
from heartfit.io.figures import write_figure
from heartfit.results.planted_figures import plot_confusion, plot_power, plot_rates
from heartfit.results.planted_summary import data_table, extent_table, planted_tables
from heartfit.results.planted_table import (
    COLUMNS,
    ClaimError,
    cases_table,
    mechanisms_table,
    populations_table,
    rates_table,
    require_claims,
)
from heartfit.synthetic.campaign import Effect
from heartfit.synthetic.case import Answer
from heartfit.synthetic.scoring import DetectableSizes, Scored
from heartfit.synthetic.trial import CONDITION, VOLUME, ScoredDiagnosis
from tests.printed import numbers_in


def scored(seed, kind, planted, verdict, names=(), size=1e-5):
    effects = tuple(Effect(name, 2.0 * size, 0.0, "m^2", 2.0) for name in planted)
    named = tuple(Cause(name, 9.0, 1.8 * size, "m^2", (1.5 * size, 2.5 * size)) for name in names)
    ranking = {"Leak": 9.0, "unknown": 2.0}
    gain = {"lv_pressure": 0.5} if named else {}
    return Scored(
        Answer(seed, kind, effects, {"no beat": 1}, {}, 0.02),
        ScoredDiagnosis(verdict, named, ranking, gain, 3000, 20.0),
    )


def less(case, verdict):
    """The same case, also searched by less and more data."""
    other = {VOLUME: ScoredDiagnosis(verdict), CONDITION: replace(case.finding, gain={"lv_pressure": 0.3})}
    return replace(case, finding=replace(case.finding, other=other))


CASES = [
    scored(1, "none", (), "none"),
    scored(2, "none", (), "named", ("Leak",)),
    scored(3, "single", ("Leak",), "named", ("Leak",)),
    scored(4, "single", ("Leak",), "unknown"),
    scored(5, "single", ("Scar",), "none"),
    scored(6, "outside", ("Whip",), "unknown"),
    scored(7, "two", ("Leak", "Scar"), "two", ("Leak", "Scar")),
]
MISSPECIFIED = [
    replace(case, answer=replace(case.answer, seed=600 + case.answer.seed, population="misspecified"))
    for case in (CASES[0], CASES[0], CASES[1], CASES[0], CASES[2], CASES[2], CASES[4])
]
LEAST = DetectableSizes({("Leak", 1.0): 1.5, ("Scar", 1.0): float("inf")})


def claims(*rows):
    return pd.DataFrame([(*row, "because") for row in rows], columns=COLUMNS)


def test_rates_are_counts_with_intervals_and_targets():
    table = rates_table(CASES).set_index("rate")
    alarms = table.loc["false alarms of nulls"]
    assert (alarms["count"], alarms["share (%)"]) == ("1 of 2", 50.0)
    assert (alarms["target (%)"], alarms["met"]) == ("<= 4", "no")
    assert alarms["low (%)"] < 50.0 < alarms["high (%)"]
    assert "singles in their group, of the groups" not in table.index


def test_a_mechanism_has_its_size_in_its_unit_and_the_named_amplitudes():
    table = mechanisms_table(CASES).set_index("planted")
    leak = table.loc["Leak"]
    assert (leak["size"], leak["cases"], leak["detected"], leak["named right"]) == ("0.2 cm^2", 2, 2, 1)
    assert leak["amplitude ratio, median"] == pytest.approx(0.9)
    assert leak["in its interval"] == "1 of 1"
    assert table.loc["Whip (outside)"]["unknown"] == 1


def test_less_and_more_data_are_a_row_each_over_the_same_cases():
    null, leak = less(CASES[0], "insufficient"), less(CASES[2], "named")
    table = data_table([null, leak, *CASES]).set_index("data")
    assert table["false alarms"].tolist() == ["0 of 1"] * 3
    assert table["detected"].tolist() == ["1 of 1"] * 3
    assert table["named right"].tolist() == [0, 1, 1]
    assert table["in their group"].tolist() == [0, 0, 0]
    assert table["named wrong"].tolist() == [1, 0, 0]
    assert table["insufficient"].tolist() == [1, 0, 0]
    assert table["held-out pressure"].tolist()[1:] == [0.5, 0.3]
    assert set(data_table(CASES)["false alarms"]) == {"0 of 0"}, "none was searched with each set"


def test_a_case_is_a_row():
    table = cases_table(CASES)
    assert len(table) == len(CASES)
    assert table["planted"].tolist()[-1] == "Leak + Scar"
    assert table["right"].tolist() == [False, False, True, False, False, False, True]


def test_claims_that_the_counts_allow_are_held():
    alarms, more = ("false alarms of nulls", 0.06, "at most"), ("singles detected at more", 0.5, "at least")
    held = require_claims(CASES, claims(alarms, more))
    assert held["counted"].tolist() == ["1 of 2"]
    assert held["doubt"].tolist() == pytest.approx([1.0 - 0.94**2])


def test_refuted_claims_are_listed_one_per_line():
    many = [scored(seed, "none", (), "unknown") for seed in range(6)]
    with pytest.raises(ClaimError, match=r"false alarms of nulls.* 6 of 6.* at most 0\.06") as error:
        require_claims(many, claims(("false alarms of nulls", 0.06, "at most")))
    assert len(str(error.value).splitlines()) == 2


@pytest.mark.parametrize("row", [("no rate", 0.1, "at most"), ("false alarms of nulls", 0.1, "about")])
def test_an_empty_claim_is_refused(row):
    with pytest.raises(ValueError, match="rate, claim, bound, why"):
        require_claims(CASES, claims(row))


def test_the_extent_states_seeds_refusals_gain_and_effort():
    table = extent_table(CASES, 3001).set_index("quantity")
    searched = table["as searched"]
    assert searched[["hearts searched", "hearts planned", "seeds"]].tolist() == ["7", "3001", "1 to 7"]
    assert searched["draws refused"] == "7 of 14", "one of two draws of each case"
    assert numbers_in(searched["held-out pressure of right names, error ratio (quartiles)"])[0] == 0.5
    assert searched[["simulations of a search, median", "core s of a search, median"]].tolist() == [
        "3000",
        "20.0",
    ]
    assert table["misspecified"]["hearts searched"] == "0"


def test_undetectable_effects_are_not_counted_as_missed():
    table = rates_table(CASES, LEAST.rates()).set_index("rate")
    assert table.loc["singles detected at 2 scales", "count"] == "2 of 3"
    assert table.loc["singles above their limit, detected", "count"] == "2 of 2"
    assert table.loc["singles above their limit, named right", "count"] == "1 of 2"


def test_both_populations_stand_beside_each_other_with_the_targets_of_the_misspecified_one():
    table = populations_table([*CASES, *MISSPECIFIED]).set_index("rate")
    alarms, _, right, _ = table.to_dict("records")
    assert (alarms["as searched"], alarms["misspecified"]) == ("1 of 2", "1 of 4")
    assert numbers_in(alarms["misspecified (%)"])[0] == 25.0
    assert (alarms["target (%)"], alarms["met"]) == ("<= 5", "no")
    assert (right["misspecified"], right["target (%)"], right["met"]) == ("2 of 2", ">= 90", "yes")
    assert table["as searched"].tolist() == ["1 of 2", "2 of 3", "1 of 1", "1 of 1"]
    assert table["misspecified"].tolist() == ["1 of 4", "2 of 3", "2 of 2", "2 of 2"]
    alone = populations_table(CASES)
    assert alone["as searched"].tolist() == table["as searched"].tolist()
    assert set(alone["misspecified"]) == set(alone["met"]) == {""}


def test_tables_of_the_hearts_as_searched_do_not_count_misspecified_ones():
    alone, both = (planted_tables(cases, LEAST, 7) for cases in (CASES, [*CASES, *MISSPECIFIED]))
    for name in ("rates", "mechanisms", "data"):
        pd.testing.assert_frame_equal(alone[name], both[name])
    assert both["cases"]["population"].tolist() == ["as searched"] * 7 + ["misspecified"] * 7


def test_the_extent_counts_misspecified_hearts_apart():
    alone, both = (extent_table(cases, 7).set_index("quantity") for cases in (CASES, [*CASES, *MISSPECIFIED]))
    assert alone["as searched"].tolist() == both["as searched"].tolist()
    assert both["misspecified"][:4].tolist() == ["7", "7", "601 to 605", "7 of 14"]


def test_a_rate_of_misspecified_hearts_may_be_claimed():
    alarms = ("misspecified: false alarms of nulls", 0.05, "at most")
    assert require_claims([*CASES, *MISSPECIFIED], claims(alarms))["counted"].tolist() == ["1 of 4"]
    assert require_claims(CASES, claims(alarms)).empty


@pytest.mark.parametrize("plot", [plot_rates, plot_confusion, plot_power])
def test_the_figure_is_drawn(plot, tmp_path):
    write_figure(tmp_path / "figure.png", plot(CASES))
    assert (tmp_path / "figure.png").stat().st_size > 5_000

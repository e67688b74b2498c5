"""Tables 1 and 2 in the paper's layout: its cells as printed, ours below in its columns, units and rounding."""

from dataclasses import replace
from pathlib import Path

import pytest

from heartfit.io.tables import read_published
from heartfit.results.as_printed import PLANTED, PLANTED_RATIOS, printed_errors, printed_parameters
from heartfit.results.case import FingerprintMismatchError, Groups
from heartfit.results.errors import PAPER
from heartfit.results.text import to_latex
from tests.results.hearts import calibrated

PUBLISHED = Path(__file__).parents[2] / "resources" / "marchesseau2012"
ERRORS, PARAMETERS = (read_published(PUBLISHED / f"{name}.csv") for name in ("table1", "table2"))
GROUPS = Groups(("volunteer1", "volunteer2"), ("real",), ("sick",))
CASES = [
    calibrated("volunteer1", errors={"V_min": -1.005, "q_max": 3.0, "q_min": 10.0}),
    calibrated("volunteer2", errors={"V_min": 2.0, "q_max": 5.0, "q_min": 20.0}, ratios={"sigma_0": 1.5}),
    calibrated("real", errors=30.0, ratios={"K": 30.0}),
    calibrated("volunteer1", "physical"),
    calibrated("sick", pressure=True),
]


def test_the_papers_rows_are_those_of_its_print() -> None:
    table = printed_errors(CASES, ERRORS, GROUPS)
    assert table.columns.tolist() == ["setting", "Volunteers", *map(str, range(1, 8)), "Mean", "real"]
    assert table.iloc[1].tolist() == [
        *(PAPER, "q_max", "3.06", "20.99", "8.57", "21.37", "11.5", "12.1", "5.36", "11.85", "")
    ]
    parameters = printed_parameters(CASES, PARAMETERS, GROUPS)
    assert parameters.iloc[1].tolist() == [
        *(PAPER, "mu (MPa.s)", "0.31", "0.31", "0.27", "0.3", "0.33", "0.26", "0.3", "0.3", "")
    ]
    assert parameters["Mean"].tolist()[:4] == ["5.8", "0.3", "12.9", "113.7"]


def test_our_errors_stand_below_one_block_a_setting() -> None:
    table = printed_errors(CASES, ERRORS, GROUPS)
    assert table["setting"].tolist() == [PAPER] * 3 + ["locking"] * 3 + ["physical"] * 3
    ours = table[table["setting"] == "locking"].set_index("Volunteers")
    assert ours.index.tolist() == ["V_min", "q_max", "q_min"]
    assert ours.loc["q_min", ["1", "2", "3", "Mean", "real"]].tolist() == [
        "10.00",
        "20.00",
        "",
        "15.00",
        "30.00 †",
    ]
    assert ours.loc["V_min", ["1", "Mean"]].tolist() in (["1.00", "1.50"], ["1.01", "1.50"]), "unsigned"
    physical = table[table["setting"] == "physical"].set_index("Volunteers")
    assert physical.loc["V_min", ["2", "Mean", "real"]].tolist() == ["", "2.00", ""], "no such calibration"


def test_our_parameters_have_the_papers_units_and_order_and_three_digits_below_one() -> None:
    table = printed_parameters(CASES, PARAMETERS, GROUPS)
    ours = table[table["setting"] == "locking"].set_index("Volunteers")
    assert ours.index.tolist() == ["sigma_0 (MPa)", "mu (MPa.s)", "K (MPa)", "R_p (MPa.s/m^3)"]
    assert ours.loc["sigma_0 (MPa)", ["1", "2", "Mean"]].tolist() == ["0.300", "0.450", "0.38"]
    assert ours.loc["mu (MPa.s)", ["1", "Mean"]].tolist() == ["0.0150", "0.015"]
    assert ours.loc["K (MPa)", "real"] == "15.000 †", "the digits are those of the row, and the step is long"
    assert not ours.drop(index="K (MPa)").stack().str.contains("†").any()
    assert ours.loc["R_p (MPa.s/m^3)", ["1", "Mean"]].tolist() == ["110.00", "110.0"]
    physical = table[table["setting"] == "physical"]
    assert physical["Volunteers"].tolist()[2] == "c_1 (MPa)", "in the place of K"


def test_what_was_planted_in_the_virtual_volunteers_stands_above_the_estimates() -> None:
    truths = {
        "volunteer1": {"sigma_0": 286e3, "mu": 11e3, "K": 1e6, "c_1": 5.5e3, "R_p": 95e6, "alpha": 8.0},
        "volunteer2": {"sigma_0": 194e3, "mu": 11e3, "K": 1e6, "c_1": 4.0e3, "R_p": 131e6, "alpha": 8.0},
        "sick": {"sigma_0": 1e3},
    }
    table = printed_parameters(CASES, PARAMETERS, GROUPS, truths)
    assert table["setting"].unique().tolist() == [PAPER, PLANTED_RATIOS, "locking", "physical"]
    planted = table[table["setting"] == PLANTED_RATIOS].set_index("Volunteers")
    assert planted.index.tolist() == ["sigma_0 (MPa)", "mu (MPa.s)", "c_1 (MPa)", "R_p (MPa.s/m^3)"], (
        "K has no truth"
    )
    assert planted.loc["sigma_0 (MPa)", ["1", "2", "3", "Mean", "real"]].tolist() == [
        "0.286",
        "0.194",
        "",
        "0.24",
        "",
    ]
    assert planted.loc["R_p (MPa.s/m^3)", ["1", "Mean"]].tolist() == ["95.00", "113.0"]
    drawn = printed_parameters(CASES, PARAMETERS, GROUPS, truths, planted_ratios=False)
    assert drawn["setting"].unique().tolist() == [PAPER, PLANTED, "locking", "physical"]


def test_a_failed_beat_is_named_and_not_in_the_mean() -> None:
    failed = replace(calibrated("volunteer2"), calibrated={})
    ours = printed_errors([CASES[0], failed], ERRORS, GROUPS).iloc[3]
    assert ours[["1", "2", "Mean"]].tolist() == [ours["1"], "failed", ours["1"]]


def test_latex_has_the_quantities_as_symbols_and_different_code_is_refused() -> None:
    assert r"$\sigma_{0}$ (MPa)" in to_latex(printed_parameters(CASES, PARAMETERS, GROUPS))
    other = replace(calibrated("volunteer2"), fingerprint="old")
    for make, paper in ((printed_errors, ERRORS), (printed_parameters, PARAMETERS)):
        with pytest.raises(FingerprintMismatchError):
            make([CASES[0], other], paper, GROUPS)

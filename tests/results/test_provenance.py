"""Every number of the tables has its origin."""

import pandas as pd
import pytest

from heartfit.results.case import Groups, Origin
from heartfit.results.errors import PAPER
from heartfit.results.provenance import numbers_table
from tests.results.small_study import CASES

GROUPS = Groups(("v1", "v2"), ("real",), ("lbbb1",))
ORIGIN = Origin(
    "results", GROUPS, {"v1": 0.8, "v2": 0.9, "real": 0.83, "lbbb1": 0.7}, {"v1": 1, "v2": 2, "lbbb1": 8}
)
TABLES = {
    "table1": pd.DataFrame(
        [
            {
                "setting": "physical",
                "case": "v1",
                "V_min (%)": 1.5,
                "V_min z": 0.3,
                "failed points": "1 of 9",
            },
            {
                "setting": "physical",
                "case": "mean of 2",
                "V_min (%)": 2.5,
                "V_min z": None,
                "failed points": None,
            },
            {"setting": "physical", "case": "mean of 3 with real", "V_min (%)": 3.5},
            {"setting": PAPER, "case": "volunteer 1", "V_min (%)": 0.35},
        ]
    ),
    "table2": pd.DataFrame([{"setting": "physical", "case": "prior", "sigma_0 (kPa)": 300.0}]),
    "table3_parameters": pd.DataFrame(
        [
            {
                "setting": "physical",
                "case": "lbbb1",
                "quantity": "sigma_0",
                "unit": "kPa",
                "value": 180.0,
                "sd (%)": 9.0,
            },
            {"setting": PAPER, "case": "LBBB case 1", "quantity": "sigma_0", "unit": "MPa", "value": "<4"},
        ]
    ),
}


@pytest.fixture
def numbers() -> pd.DataFrame:
    return numbers_table(TABLES, CASES, ORIGIN)


def test_every_cell_with_a_number_is_there_once(numbers):
    keys = {"setting", "case", "quantity", "unit"}
    cells = sum(
        int(table.drop(columns=list(keys & set(table))).notna().sum().sum()) for table in TABLES.values()
    )
    assert len(numbers) == cells == 10
    assert not numbers.duplicated(["table", "setting", "case", "quantity"]).any()
    assert numbers["run"].notna().all()


def test_marks_of_numbers_are_not_among_them(numbers):
    """Marks come and go with the last digits; tables of one study would have other rows on another processor."""
    marked = {
        name: table.assign(**{"below noise": "V_min", "long steps": "K -3.0"})
        for name, table in TABLES.items()
    }
    pd.testing.assert_frame_equal(numbers_table(marked, CASES, ORIGIN), numbers)


def test_a_number_of_a_case_knows_its_run_parameters_seed_and_code(numbers):
    row = numbers[(numbers["case"] == "v1") & (numbers["quantity"] == "V_min")].iloc[0]
    assert (row["value"], row["unit"], row["seed"], row["period (s)"]) == (1.5, "%", 1, 0.8)
    assert row["run"] == "results/v1/physical/verification/errors.json"
    assert row["parameters"] == "sigma_0=290000 Pa; K=600000 Pa"
    assert row["fingerprint"] == "abc"


def test_means_name_their_cases_and_the_papers_rows_its_table(numbers):
    run = numbers.groupby("case")["run"].first()
    assert run["mean of 2"] == "results/{v1,v2}/physical/verification/errors.json"
    assert run["mean of 3 with real"] == "results/{v1,v2,real}/physical/verification/errors.json"
    assert run["volunteer 1"] == "resources/marchesseau2012/table1.csv"
    assert run["LBBB case 1"] == "resources/marchesseau2012/patients.csv"
    assert run["prior"] == "results/v1/physical/calibration/points.json"


def test_units_stand_in_the_heading_or_in_the_row(numbers):
    patient = numbers[numbers["case"] == "lbbb1"].set_index("quantity")["unit"]
    assert patient.to_dict() == {"sigma_0 value": "kPa", "sigma_0 sd": "%"}
    assert (numbers[numbers["quantity"] == "V_min z"]["unit"] == "").all()

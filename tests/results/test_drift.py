"""Drifted numbers are listed with advice; missing ones count as drifted."""

import pandas as pd
import pytest

from heartfit.core.errors import InputError
from heartfit.results.provenance import TOLERANCE_COLUMNS, DriftError, renew_tolerances, require_no_drift
from tests.printed import numbers_in

NUMBERS = pd.DataFrame(
    [
        {"table": "table1", "setting": "physical", "case": "mean of 7", "quantity": "V_min", "value": "1.3"},
        {"table": "table1", "setting": "physical", "case": "v1", "quantity": "V_min", "value": "0.4"},
        {
            "table": "table1",
            "setting": "physical",
            "case": "v1",
            "quantity": "failed points",
            "value": "0 of 9",
        },
    ]
)


def tolerances(*rows: tuple[str, str, float, float]) -> pd.DataFrame:
    return pd.DataFrame([("table1", "physical", *row, "mesh") for row in rows], columns=TOLERANCE_COLUMNS)


def test_numbers_within_their_tolerance_pass():
    drift = require_no_drift(
        NUMBERS, tolerances(("mean of 7", "V_min", 1.5, 0.21), ("v1", "V_min", 0.4, 0.0))
    )
    assert drift["measured"].tolist() == [1.3, 0.4]


def test_drifted_and_missing_numbers_are_listed_with_advice():
    rows = (("mean of 7", "V_min", 1.5, 0.1), ("v1", "V_min", 0.4, 0.1), ("v9", "V_min", 1.0, 9.0))
    with pytest.raises(DriftError) as error:
        require_no_drift(NUMBERS, tolerances(*rows))
    lines = str(error.value).splitlines()
    assert numbers_in(lines[0]) == [2.0, 3.0]
    assert [part for part in ("table1", "physical", "mean of 7", "V_min") if part not in lines[1]] == []
    assert numbers_in(lines[1].replace("mean of 7", "")) == [1.5, 0.1, 1.3]
    assert [part for part in ("v9", "V_min", "nan") if part not in lines[2]] == []
    assert numbers_in(lines[2]) == [1.0, 9.0]
    assert "heartfit tolerances" in lines[3]


def test_nan_counts_as_drifted():
    with pytest.raises(DriftError, match=r"failed points.*nan"):
        require_no_drift(NUMBERS, tolerances(("v1", "failed points", 0.0, 1.0)))


def test_renewing_keeps_rows_tolerances_and_what_is_not_there():
    renewed = renew_tolerances(NUMBERS, tolerances(("v1", "V_min", 9.0, 0.1), ("v9", "V_min", 1.0, 0.2)))
    assert list(renewed.columns) == TOLERANCE_COLUMNS
    assert renewed["expected"].tolist() == [0.4, 1.0]
    assert renewed["tolerance"].tolist() == [0.1, 0.2]


@pytest.mark.parametrize("table", [tolerances(), tolerances(("v1", "V_min", 1.0, 0.1)).drop(columns="why")])
def test_an_empty_table_is_refused(table):
    with pytest.raises(InputError, match=f"{len(table)} rows.*{', '.join(TOLERANCE_COLUMNS)}"):
        require_no_drift(NUMBERS, table)

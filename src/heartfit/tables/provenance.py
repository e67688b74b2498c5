"""Every number of the tables once, with where it comes from."""

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import pandas as pd

from heartfit.tables.case import CaseResult
from heartfit.tables.errors_table import PAPER
from heartfit.tables.fingerprints import require_one_fingerprint
from heartfit.tables.groups import Origin

KEYS = ("setting", "case", "quantity", "unit")
PUBLISHED = {
    "table1": "table1.csv",
    "table2": "table2.csv",
    "table3": "patients.csv",
    "table3_parameters": "patients.csv",
}
"""Where the paper's rows of a table stand, below resources/marchesseau2012."""


def numbers_table(
    tables: Mapping[str, pd.DataFrame], cases: Sequence[CaseResult], origin: Origin
) -> pd.DataFrame:
    """One row per cell of the tables, by their names, that is not empty.

    quantity and unit are those of the column's heading, after the row's own quantity if it has one; run is the result
    behind the number, for a mean those of its cases in braces; parameters, SI, seed, period and fingerprint are those
    of the run. Raises FingerprintMismatchError for cases of different code.
    """
    fingerprint = require_one_fingerprint(cases)
    known = {(case.setting, case.case): case for case in cases}
    rows = [row for name, table in tables.items() for row in _cells(name, table)]
    return pd.DataFrame([row | _origin(row, known, origin, fingerprint) for row in rows])


def _cells(name: str, table: pd.DataFrame) -> Iterable[dict[str, Any]]:
    for row in table.to_dict("records"):
        for column, value in row.items():
            if column not in KEYS and value != "" and not pd.isna(value):
                quantity, unit = _heading(str(column), row)
                key = {"setting": row["setting"], "case": row["case"], "quantity": quantity}
                yield {"table": name, **key, "value": value, "unit": unit}


def _heading(column: str, row: Mapping[str, Any]) -> tuple[str, str]:
    """ "V_min floor (%)" is V_min floor in %; a column without a unit has that of its row, but for ratios."""
    found = re.fullmatch(r"(.+?)(?: \(([^()]+)\))?", column)
    name, unit = (found[1], found[2]) if found else (column, None)
    of_row = row.get("unit", "") if name in ("value", "healthy mean") else ""
    return f"{row['quantity']} {name}" if "quantity" in row else name, unit or of_row


def _origin(
    row: Mapping[str, Any], cases: Mapping[tuple[str, str], CaseResult], origin: Origin, fingerprint: str
) -> dict[str, Any]:
    if row["setting"] == PAPER:
        return {"run": f"resources/marchesseau2012/{PUBLISHED[row['table']]}"}
    found = {"run": _run(row, cases, origin), "fingerprint": fingerprint}
    case = cases.get((row["setting"], row["case"]))
    if case is None:
        return found
    parameters = "; ".join(f"{name}={value:.6g} {case.units[name]}" for name, value in case.estimate.items())
    return found | {
        "parameters": parameters,
        "seed": origin.seeds.get(case.case),
        "period (s)": origin.periods[case.case],
    }


def _run(row: Mapping[str, Any], cases: Mapping[tuple[str, str], CaseResult], origin: Origin) -> str:
    setting, case = row["setting"], row["case"]
    first = next(name for of, name in cases if of == setting)
    if case == "prior":
        return f"{origin.results}/{first}/{setting}/calibration/points.json"
    means = [names for suffix, names in origin.groups.means.items() if case.endswith(suffix)]
    who = "{" + ",".join(means[-1]) + "}" if case.startswith("mean of ") else case
    return f"{origin.results}/{who}/{setting}/verification/errors.json"

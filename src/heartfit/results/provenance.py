"""Provenance of the numbers of the tables: origin of each number, and merged shards."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import pandas as pd

from heartfit.core.errors import InputError
from heartfit.results.case import CaseResult, Origin, require_one_fingerprint
from heartfit.results.errors import BELOW_NOISE, PAPER
from heartfit.results.text import LONG_STEPS

ROW_KEY = ["table", "setting", "case", "quantity"]
ROW_VALUE = ["value", "unit", "fingerprint"]
COHORT_QUANTITY = r"(?:over|healthy) mean$"
RATIO_SUFFIXES = {"": " over mean", " value": " over healthy mean"}
"""Suffix of an estimated parameter, and of its ratio to the healthy mean."""


def merge_shards(numbers: Mapping[str, pd.DataFrame]) -> pd.DataFrame:
    """Return all rows of the shards, each row once; shards that share a row must agree in value and code.

    numbers: tables by the name of the shard. Means and ratios to the healthy hearts of one shard are left out;
    estimates over the mean of the virtual volunteers are computed again over all shards. Raises InputError for shards
    of different code or machines.
    """
    rows = pd.concat([table.assign(shard=name) for name, table in numbers.items()], ignore_index=True)
    of_cohort = rows["quantity"].str.contains(COHORT_QUANTITY) | rows["case"].str.startswith("mean of ")
    of_shard = of_cohort & (rows["fingerprint"] != "")
    per_case = _drop_agreeing_duplicates(rows[~of_shard])
    return pd.concat([per_case, *_ratios_to_healthy_mean(per_case, rows[of_shard])], ignore_index=True)


def calibrated_cases(numbers: pd.DataFrame) -> set[str]:
    """Return the calibrated cases among the rows, without priors and the rows of the paper."""
    return {*numbers.loc[numbers["parameters"] != "", "case"]}


def _ratios_to_healthy_mean(rows: pd.DataFrame, of_shard: pd.DataFrame) -> Iterator[pd.DataFrame]:
    """Return ratios to the mean of the virtual volunteers for the rows that a shard has such ratios of."""
    estimated = rows.assign(value=pd.to_numeric(rows["value"], errors="coerce")).dropna(subset=["value"])
    virtual = estimated[(estimated["table"] == "table2") & (estimated["seed"] != "")]
    means = virtual.groupby(["setting", "quantity"])["value"].mean()
    for ending, ratio in RATIO_SUFFIXES.items():
        names = estimated["quantity"].str.removesuffix(ending)
        mean = pd.MultiIndex.from_arrays([estimated["setting"], names]).map(means)
        ratios = estimated.assign(quantity=names + ratio, value=estimated["value"] / mean, unit="")
        yield ratios.merge(of_shard[ROW_KEY].drop_duplicates(), on=ROW_KEY)


def _drop_agreeing_duplicates(rows: pd.DataFrame) -> pd.DataFrame:
    """Return each row once; raises InputError for a row with two values."""
    distinct = rows.drop_duplicates([*ROW_KEY, *ROW_VALUE])
    conflicts = distinct[distinct.duplicated(ROW_KEY, keep=False)]
    if len(conflicts):
        same_row = conflicts[ROW_KEY].eq(conflicts.iloc[0][ROW_KEY]).all(axis=1)
        first, other = conflicts[same_row].head(2).to_dict("records")
        raise InputError(
            f"{other['shard']}: {other['quantity']} of {other['case']} is {other['value']}, in {first['shard']} "
            f"{first['value']}; expected the same number from the same code: run both shards again"
        )
    return rows.drop_duplicates(ROW_KEY).reset_index(drop=True)


def summarise_cohort(numbers: pd.DataFrame) -> pd.DataFrame:
    """Return mean, deviation, minimum and maximum of each quantity over the cases per table and setting."""
    values = numbers.assign(value=pd.to_numeric(numbers["value"], errors="coerce")).dropna(subset=["value"])
    grouped = values.groupby(["table", "setting", "quantity", "unit"], sort=False, dropna=False)["value"]
    statistics = grouped.agg(cases="count", mean="mean", sd="std", least="min", largest="max")
    return statistics.reset_index()


NO_NUMBERS = ("setting", "case", "quantity", "unit", BELOW_NOISE, LONG_STEPS)
"""Columns of keys, and of marks that say something about the numbers next to them."""
PUBLISHED = {
    "table1": "table1.csv",
    "table2": "table2.csv",
    "table3": "patients.csv",
    "table3_parameters": "patients.csv",
}
"""File of the rows of the paper by table, in resources/marchesseau2012."""


def numbers_table(
    tables: Mapping[str, pd.DataFrame], cases: Sequence[CaseResult], origin: Origin
) -> pd.DataFrame:
    """Return one row per number of the tables, which are given by name; marks of numbers are left out.

    quantity and unit are those of the column heading, after the quantity of the row if it has one; run is the result
    behind the number, for a mean those of its cases in braces; parameters (SI), seed, period and fingerprint are those
    of the run. Raises FingerprintMismatchError for cases of different code.
    """
    fingerprint = require_one_fingerprint(cases)
    by_key = {(case.setting, case.case): case for case in cases}
    rows = [row for name, table in tables.items() for row in _cells(name, table)]
    return pd.DataFrame([row | _origin(row, by_key, origin, fingerprint) for row in rows])


def _cells(name: str, table: pd.DataFrame) -> Iterable[dict[str, Any]]:
    for row in table.to_dict("records"):
        for column, value in row.items():
            if column not in NO_NUMBERS and value != "" and not pd.isna(value):
                quantity, unit = _heading(str(column), row)
                key = {"setting": row["setting"], "case": row["case"], "quantity": quantity}
                yield {"table": name, **key, "value": value, "unit": unit}


def _heading(column: str, row: Mapping[str, Any]) -> tuple[str, str]:
    """Return "V_min floor" and "%" for "V_min floor (%)"; only values and means take the unit of their row."""
    match = re.fullmatch(r"(.+?)(?: \(([^()]+)\))?", column)
    name, unit = (match[1], match[2]) if match else (column, None)
    row_unit = row.get("unit", "") if name in ("value", "healthy mean") else ""
    return f"{row['quantity']} {name}" if "quantity" in row else name, unit or row_unit


def _origin(
    row: Mapping[str, Any], cases: Mapping[tuple[str, str], CaseResult], origin: Origin, fingerprint: str
) -> dict[str, Any]:
    if row["setting"] == PAPER:
        return {"run": f"resources/marchesseau2012/{PUBLISHED[row['table']]}"}
    base = {"run": _run(row, cases, origin), "fingerprint": fingerprint}
    case = cases.get((row["setting"], row["case"]))
    if case is None:
        return base
    parameters = "; ".join(f"{name}={value:.6g} {case.units[name]}" for name, value in case.estimate.items())
    return base | {
        "parameters": parameters,
        "seed": origin.seeds.get(case.case),
        "period (s)": origin.periods[case.case],
    }


def _run(row: Mapping[str, Any], cases: Mapping[tuple[str, str], CaseResult], origin: Origin) -> str:
    setting, case = row["setting"], row["case"]
    first = next(name for name_of_setting, name in cases if name_of_setting == setting)
    if case == "prior":
        return f"{origin.results}/{first}/{setting}/calibration/points.json"
    means = [names for suffix, names in origin.groups.means.items() if case.endswith(suffix)]
    folder = "{" + ",".join(means[-1]) + "}" if case.startswith("mean of ") else case
    return f"{origin.results}/{folder}/{setting}/verification/errors.json"

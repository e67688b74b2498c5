"""Table 1: relative errors between simulated and measured observations, beside the paper's."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from heartfit.tables.case import CaseResult
from heartfit.tables.fingerprints import require_one_fingerprint

PAPER = "Marchesseau et al. 2012"


def error_table(cases: Sequence[CaseResult], paper: pd.DataFrame) -> pd.DataFrame:
    """One row per case under each setting and their mean, then the paper's volunteers and their mean.

    Errors are unsigned percentages as in the paper; "floor" is the measurement's own noise. paper: its Table
    1 as published (observation, 1..7, mean). Raises FingerprintMismatchError for rows of different code.
    """
    require_one_fingerprint(cases)
    table: list[dict[str, Any]] = []
    for setting in dict.fromkeys(case.setting for case in cases):
        rows = [_row(case) for case in cases if case.setting == setting]
        table += [*rows, _mean(setting, rows)]
    return pd.DataFrame([*table, *_paper_rows(paper)])


def _row(case: CaseResult) -> dict[str, Any]:
    errors = {name: abs(error) for name, error in case.errors().items()}
    prior = [abs(error) for error in case.reference_errors().values()]
    floor = case.floor()
    row: dict[str, Any] = {"setting": case.setting, "case": case.case}
    for name, error in errors.items():
        row |= {f"{name} (%)": error, f"{name} floor (%)": floor[name]}
    return row | {
        "mean (%)": np.mean(list(errors.values())),
        "prior mean (%)": np.mean(prior),
        **_fits(case.root_mean_square),
        "failed points": f"{case.failed_points} of {case.sigma_points}",
    }


def _fits(root_mean_square: Mapping[str, float]) -> dict[str, float]:
    return {
        f"{side.upper()} RMS (mL)": 1e6 * root_mean_square[f"{side}_volume"]
        for side in ("lv", "rv")
        if f"{side}_volume" in root_mean_square
    }


def _mean(setting: str, rows: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Column means over the cases whose verification completed, as the row's name says."""
    completed = [row for row in rows if np.isfinite(row["mean (%)"])]
    numbers = pd.DataFrame(completed).select_dtypes("number").mean()
    return {"setting": setting, "case": f"mean of {len(completed)}", **numbers.to_dict()}


def _paper_rows(paper: pd.DataFrame) -> list[dict[str, Any]]:
    table = paper.set_index("observation")
    return [
        {
            "setting": PAPER,
            "case": "mean of 7" if column == "mean" else f"volunteer {column}",
            **{f"{name} (%)": error for name, error in table[column].items()},
            "mean (%)": table[column].mean(),
        }
        for column in table.columns
    ]

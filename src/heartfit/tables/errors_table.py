"""Table 1: relative errors between simulated and measured observations of the healthy, beside the paper's."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from heartfit.tables.case import CaseResult
from heartfit.tables.fingerprints import require_one_fingerprint
from heartfit.tables.groups import Groups

PAPER = "Marchesseau et al. 2012"
BELOW = "below noise"


def error_table(cases: Sequence[CaseResult], paper: pd.DataFrame, groups: Groups) -> pd.DataFrame:
    """One row per healthy case under each setting and their means, then the paper's volunteers and their mean.

    Errors are unsigned percentages as in the paper; "floor" is the measurement's own noise, "z" the one over the
    other, and "below noise" names the observations with z < 1: being met better than they were measured is no merit.
    The mean is that of the virtual volunteers, then with the measured hearts. paper: its Table 1 as published
    (observation, 1..7, mean). Raises FingerprintMismatchError for rows of different code.
    """
    require_one_fingerprint(cases)
    table: list[dict[str, Any]] = []
    for setting in dict.fromkeys(case.setting for case in cases):
        rows = {
            case.case: _row(case) for case in cases if case.setting == setting and case.case in groups.healthy
        }
        table += rows.values()
        table += [
            _mean(setting, [row for name, row in rows.items() if name in names], suffix)
            for suffix, names in groups.means.items()
        ]
    return pd.DataFrame([*table, *_paper_rows(paper)])


def below_noise(case: CaseResult) -> str:
    """Names of the observations that are met to better than their noise."""
    return ", ".join(name for name, score in case.scores().items() if abs(score) < 1.0)


def _row(case: CaseResult) -> dict[str, Any]:
    errors, floor, scores = case.errors(), case.floor(), case.scores()
    row: dict[str, Any] = {"setting": case.setting, "case": case.case}
    for name, error in errors.items():
        row |= {f"{name} (%)": abs(error), f"{name} floor (%)": floor[name], f"{name} z": abs(scores[name])}
    return row | {
        "mean (%)": mean_error(errors),
        "prior mean (%)": mean_error(case.reference_errors()),
        BELOW: below_noise(case),
        **_fits(case.root_mean_square),
        "failed points": f"{case.failed_points} of {case.sigma_points}",
    }


def mean_error(errors: Mapping[str, float]) -> float:
    """Mean of the unsigned errors, as the paper takes it."""
    return float(np.mean(np.abs(list(errors.values()))))


def _fits(root_mean_square: Mapping[str, float]) -> dict[str, float]:
    return {
        f"{side.upper()} RMS (mL)": 1e6 * root_mean_square[f"{side}_volume"]
        for side in ("lv", "rv")
        if f"{side}_volume" in root_mean_square
    }


def _mean(setting: str, rows: Sequence[Mapping[str, Any]], suffix: str) -> dict[str, Any]:
    """Column means over the cases whose verification completed, as the row's name says."""
    completed = [row for row in rows if np.isfinite(row["mean (%)"])]
    numbers = pd.DataFrame(completed).select_dtypes("number").mean()
    return {"setting": setting, "case": f"mean of {len(completed)}{suffix}", BELOW: "", **numbers.to_dict()}


def _paper_rows(paper: pd.DataFrame) -> list[dict[str, Any]]:
    table = paper.set_index("observation")
    return [
        {
            "setting": PAPER,
            "case": "mean of 7" if column == "mean" else f"volunteer {column}",
            **{f"{name} (%)": error for name, error in table[column].items()},
            "mean (%)": table[column].mean(),
            BELOW: "",
        }
        for column in table.columns
    ]

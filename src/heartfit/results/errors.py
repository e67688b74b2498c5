"""Table 1: relative errors between simulated and measured observations of healthy hearts, with those of the paper."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from heartfit.core.arrays import Floats
from heartfit.results.case import CaseResult, Groups, require_one_fingerprint
from heartfit.results.text import LONG_STEPS, printed_steps

PAPER = "Marchesseau et al. 2012"
BELOW_NOISE = "below noise"


def error_table(cases: Sequence[CaseResult], paper: pd.DataFrame, groups: Groups) -> pd.DataFrame:
    """One row per healthy case under each setting and their means, then the paper's volunteers and their mean.

    Errors are unsigned percentages as in the paper; "floor" is the noise of the measurement, "z" the error over
    the floor, and "below noise" names the observations with z < 1, which are fitted better than they were measured.
    The mean is that of the virtual volunteers, then with the measured hearts; a setting without
    volunteers has none.
    paper: its Table 1 as published (observation, 1..7, mean). Raises FingerprintMismatchError for rows of different
    code.
    """
    require_one_fingerprint(cases)
    table: list[dict[str, Any]] = []
    for setting in dict.fromkeys(case.setting for case in cases):
        rows = {
            case.case: _case_row(case)
            for case in cases
            if case.setting == setting and case.case in groups.healthy
        }
        table += rows.values()
        table += [
            _mean_row(setting, [row for name, row in rows.items() if name in names], suffix)
            for suffix, names in groups.means.items()
            if not groups.volunteers or rows.keys() & {*groups.volunteers}
        ]
    return pd.DataFrame([*table, *_paper_rows(paper)])


def below_noise(case: CaseResult) -> str:
    """Return the names of the observations that are fitted to better than their noise."""
    return ", ".join(name for name, score in case.scores().items() if abs(score) < 1.0)


def _case_row(case: CaseResult) -> dict[str, Any]:
    errors, floor, scores = case.errors(), case.floor(), case.scores()
    row: dict[str, Any] = {"setting": case.setting, "case": case.case}
    for name, error in errors.items():
        row |= {f"{name} (%)": abs(error), f"{name} floor (%)": floor[name], f"{name} z": abs(scores[name])}
    return row | {
        "mean (%)": mean_error(errors),
        "prior mean (%)": mean_error(case.reference_errors()),
        BELOW_NOISE: below_noise(case),
        **_volume_fits(case.root_mean_square),
        "failed points": f"{case.failed_points} of {case.sigma_points}",
        LONG_STEPS: printed_steps(case.long_steps()),
    }


def mean_error(errors: Mapping[str, float]) -> float:
    """Return the mean of the unsigned errors, as the paper's."""
    return float(np.mean(np.abs(list(errors.values()))))


def root_mean_square(values: Floats | Sequence[float], axis: int | None = None) -> Floats:
    """Return sqrt(mean(x^2))."""
    return np.sqrt(np.mean(np.square(values), axis=axis))


def _volume_fits(misfits: Mapping[str, float]) -> dict[str, float]:
    return {
        f"{side.upper()} RMS (mL)": 1e6 * misfits[f"{side}_volume"]
        for side in ("lv", "rv")
        if f"{side}_volume" in misfits
    }


def _mean_row(setting: str, rows: Sequence[Mapping[str, Any]], suffix: str) -> dict[str, Any]:
    """Return the column means over the cases whose verification completed; their number is in the name of the row."""
    completed = [row for row in rows if np.isfinite(row["mean (%)"])]
    numbers = pd.DataFrame(completed).select_dtypes("number").mean()
    return {
        "setting": setting,
        "case": f"mean of {len(completed)}{suffix}",
        BELOW_NOISE: "",
        LONG_STEPS: "",
        **numbers.to_dict(),
    }


def _paper_rows(paper: pd.DataFrame) -> list[dict[str, Any]]:
    table = paper.set_index("observation")
    return [
        {
            "setting": PAPER,
            "case": "mean of 7" if column == "mean" else f"volunteer {column}",
            **{f"{name} (%)": error for name, error in table[column].items()},
            "mean (%)": table[column].mean(),
            BELOW_NOISE: "",
            LONG_STEPS: "",
        }
        for column in table.columns
    ]


def plausibility_table(cases: Sequence[CaseResult]) -> pd.DataFrame:
    """One row per case and setting: volumes that were not fitted, pressures, wall volume and periodicity.

    Errors are signed percentages; EDV and ESV are the largest and the smallest volume. Cells of a failed beat
    are empty. Raises FingerprintMismatchError for rows of different code.
    """
    require_one_fingerprint(cases)
    return pd.DataFrame([_plausibility_row(case) for case in cases])


def _plausibility_row(case: CaseResult) -> dict[str, Any]:
    guards = case.guards
    row: dict[str, Any] = {"setting": case.setting, "case": case.case}
    for side in ("lv", "rv"):
        for index in ("EDV", "ESV"):
            row[f"{side.upper()} {index} (%)"] = guards.get(f"{side}_{index}_error_percent")
        row[f"{side.upper()} peak (kPa)"] = _scaled(guards.get(f"{side}_peak_pressure"), 1e-3)
    return row | {
        "wall volume loss (%)": _scaled(guards.get("wall_volume_loss"), 100.0),
        "beats": guards.get("beats"),
        "drift (%)": _scaled(guards.get("drift"), 100.0),
        "trigger shift (ms)": 1e3 * case.shift,
        "notes": "; ".join(case.notes),
    }


def _scaled(value: float | None, factor: float) -> float | None:
    return None if value is None else factor * value

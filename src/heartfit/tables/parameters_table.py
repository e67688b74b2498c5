"""Table 2: the estimated parameters of the healthy, beside the paper's and, where there is one, the truth."""

from collections.abc import Mapping, Sequence
from math import log

import pandas as pd

from heartfit.tables.case import CaseResult
from heartfit.tables.display import heading, printed
from heartfit.tables.errors_table import PAPER
from heartfit.tables.evaluation import truth_errors
from heartfit.tables.fingerprints import require_one_fingerprint
from heartfit.tables.groups import Groups

LONGEST = "longest step (prior sd)"  # beyond three, an estimate is an extrapolation


def parameter_table(
    cases: Sequence[CaseResult],
    paper: pd.DataFrame,
    groups: Groups,
    truths: Mapping[str, Mapping[str, float]] | None = None,
) -> pd.DataFrame:
    """The prior of each setting, one row per healthy case with posterior deviations, then the paper's volunteers.

    "sd" is the relative standard deviation in percent, "over mean" the ratio to the mean of the virtual volunteers, of
    the paper's to its own, "of truth" the relative error against the truth of a virtual volunteer (truths: by case,
    SI), where the generator has that parameter. paper: its Table 2 as published (parameter, unit, 1..7, mean). Raises
    FingerprintMismatchError for rows of different code.
    """
    require_one_fingerprint(cases)
    first = {case.setting: case for case in reversed(cases)}
    rows = []
    for setting in dict.fromkeys(case.setting for case in cases):
        of_setting = [case for case in cases if case.setting == setting]
        mean = healthy_mean(of_setting, groups)
        rows.append(_prior_row(first[setting]))
        healthy = [case for case in of_setting if case.case in groups.healthy]
        rows += [_row(case, mean, (truths or {}).get(case.case, {})) for case in healthy]
    return _in_order(pd.DataFrame([*rows, *_paper_rows(paper)]), paper["parameter"].tolist())


def healthy_mean(cases: Sequence[CaseResult], groups: Groups) -> dict[str, float]:
    """Mean of each estimated parameter over the virtual volunteers among the cases of one setting, SI."""
    estimates = [case.estimate for case in cases if case.case in groups.volunteers]
    return pd.DataFrame(estimates).mean().to_dict() if estimates else {}


def _in_order(table: pd.DataFrame, names: list[str]) -> pd.DataFrame:
    """What belongs to one parameter side by side, the paper's parameters first."""
    place = {name: index for index, name in enumerate(["setting", "case", LONGEST.split()[0], *names])}
    return table[sorted(table.columns, key=lambda column: place.get(column.split()[0], len(place)))]


def _prior_row(case: CaseResult) -> dict[str, object]:
    row: dict[str, object] = {"setting": case.setting, "case": "prior"}
    for name, value in case.prior.items():
        row |= {
            heading(name, case.units[name]): printed(value, case.units[name]),
            f"{name} sd (%)": 100 * case.prior_sd[name],
        }
    return row


def _row(case: CaseResult, mean: Mapping[str, float], truth: Mapping[str, float]) -> dict[str, object]:
    errors = truth_errors(case, truth)
    steps = [
        abs(log(value / case.prior[name])) / case.prior_sd[name] for name, value in case.estimate.items()
    ]
    row: dict[str, object] = {"setting": case.setting, "case": case.case, LONGEST: max(steps)}
    for name, value in case.estimate.items():
        row |= {
            heading(name, case.units[name]): printed(value, case.units[name]),
            f"{name} sd (%)": 100 * case.estimate_sd[name],
        }
        if name in mean:
            row[f"{name} over mean"] = value / mean[name]
        if name in errors:
            row[f"{name} of truth (%)"] = errors[name]
    return row


def _paper_rows(paper: pd.DataFrame) -> list[dict[str, object]]:
    table = paper.set_index(["parameter", "unit"])
    return [
        {
            "setting": PAPER,
            "case": "mean of 7" if column == "mean" else f"volunteer {column}",
            **{heading(name, unit): printed(value, unit) for (name, unit), value in table[column].items()},
            **{f"{name} over mean": value for (name, _), value in (table[column] / table["mean"]).items()},
        }
        for column in table.columns
    ]

"""Table 2: estimated parameters of healthy hearts, those of the paper and, for virtual hearts, the truth."""

from collections.abc import Mapping, Sequence
from math import log
from typing import Any

import pandas as pd

from heartfit.calibration.plausible import Plausible, PlausibleRange
from heartfit.calibration.sensitivity import Sensitivity
from heartfit.core.parameter import column_heading, printed_unit, to_printed_unit
from heartfit.results.card import comparable_truth, truth_errors
from heartfit.results.case import CaseResult, Groups, require_one_fingerprint
from heartfit.results.errors import PAPER
from heartfit.results.text import LONG_STEPS, printed_steps

LONGEST_STEP = "longest step (prior sd)"


def parameter_table(
    cases: Sequence[CaseResult],
    paper: pd.DataFrame,
    groups: Groups,
    truths: Mapping[str, Mapping[str, float]] | None = None,
) -> pd.DataFrame:
    """Return the prior of each setting, one row per healthy case, then the volunteers of the paper.

    "sd" is the relative standard deviation [%], "over mean" the ratio to the mean of the virtual volunteers (for the
    paper to its own mean), "planted over mean" the same ratio of the truths that were planted in them (truths: by case,
    SI), "of truth" the relative error against the truth, for parameters of the generator. paper: its Table 2 as
    published (parameter, unit, 1..7, mean). Raises FingerprintMismatchError for rows of different code.
    """
    require_one_fingerprint(cases)
    first = {case.setting: case for case in reversed(cases)}
    planted = planted_ratios(groups, truths or {})
    rows = []
    for setting in dict.fromkeys(case.setting for case in cases):
        in_setting = [case for case in cases if case.setting == setting]
        mean = healthy_mean(in_setting, groups)
        rows.append(_prior_row(first[setting]))
        healthy = [case for case in in_setting if case.case in groups.healthy]
        rows += [
            _case_row(case, mean, (truths or {}).get(case.case, {}), planted.get(case.case, {}))
            for case in healthy
        ]
    return _sort_columns(pd.DataFrame([*rows, *_paper_rows(paper)]), paper["parameter"].tolist())


def healthy_mean(cases: Sequence[CaseResult], groups: Groups) -> dict[str, float]:
    """Return the mean of each estimated parameter over the virtual volunteers among the cases of a setting, SI."""
    estimates = [case.estimate for case in cases if case.case in groups.volunteers]
    return pd.DataFrame(estimates).mean().to_dict() if estimates else {}


def planted_ratios(groups: Groups, truths: Mapping[str, Mapping[str, float]]) -> dict[str, dict[str, float]]:
    """Return the true parameters of each virtual volunteer over the mean of them all."""
    true_values = {case: comparable_truth(truths[case]) for case in groups.volunteers if case in truths}
    mean = pd.DataFrame(list(true_values.values())).mean().to_dict()
    return {
        case: {name: value / mean[name] for name, value in values.items()}
        for case, values in true_values.items()
    }


def _sort_columns(table: pd.DataFrame, names: list[str]) -> pd.DataFrame:
    """Return the table with the columns of each parameter side by side, the parameters of the paper first."""
    first = ["setting", "case", LONGEST_STEP.split()[0], LONG_STEPS.split()[0], *names]
    place = {name: index for index, name in enumerate(first)}
    table = table.fillna({LONG_STEPS: ""}) if LONG_STEPS in table else table
    return table[sorted(table.columns, key=lambda column: place.get(column.split()[0], len(place)))]


def _prior_row(case: CaseResult) -> dict[str, object]:
    row: dict[str, object] = {"setting": case.setting, "case": "prior"}
    for name, value in case.prior.items():
        row |= {
            column_heading(name, case.units[name]): to_printed_unit(value, case.units[name]),
            f"{name} sd (%)": 100 * case.prior_sd[name],
        }
    return row


def _case_row(
    case: CaseResult, mean: Mapping[str, float], truth: Mapping[str, float], planted: Mapping[str, float]
) -> dict[str, object]:
    errors = truth_errors(case, truth)
    row: dict[str, object] = {
        "setting": case.setting,
        "case": case.case,
        LONGEST_STEP: max(map(abs, case.steps().values())),
        LONG_STEPS: printed_steps(case.long_steps()),
    }
    for name, value in case.estimate.items():
        row |= {
            column_heading(name, case.units[name]): to_printed_unit(value, case.units[name]),
            f"{name} sd (%)": 100 * case.estimate_sd[name],
        }
        if name in mean:
            row[f"{name} over mean"] = value / mean[name]
        if name in planted:
            row[f"{name} planted over mean"] = planted[name]
        if name in errors:
            row[f"{name} of truth (%)"] = errors[name]
    return row


def _paper_rows(paper: pd.DataFrame) -> list[dict[str, object]]:
    table = paper.set_index(["parameter", "unit"])
    return [
        {
            "setting": PAPER,
            "case": "mean of 7" if column == "mean" else f"volunteer {column}",
            **{
                column_heading(name, unit): to_printed_unit(value, unit)
                for (name, unit), value in table[column].items()
            },
            **{f"{name} over mean": value for (name, _), value in (table[column] / table["mean"]).items()},
        }
        for column in table.columns
    ]


def prior_table(
    ranges: Mapping[str, Plausible], sensitivities: Mapping[str, Sensitivity], units: Mapping[str, str]
) -> pd.DataFrame:
    """Return per setting and parameter: plausible range and its limiting quantities, X0 and sd by the rule and as used.

    "off (sd)" is the distance of the used X0 from that of the rule in used standard deviations. The last row of a
    setting names the quantities that the standard beat already violates; they limit no parameter.
    """
    rows: list[dict[str, Any]] = []
    for setting, plausible in ranges.items():
        used = sensitivities[setting].prior
        medians = used.physical()
        for plausible_range, sd in zip(plausible.ranges, used.sd.tolist(), strict=True):
            name = plausible_range.parameter
            rows.append({"setting": setting, **_range_row(plausible_range, medians[name], sd, units[name])})
        if plausible.broken:
            rows.append({"setting": setting, "parameter": f"not kept: {', '.join(plausible.broken)}"})
    return pd.DataFrame(rows).fillna({"unit": "", "stopped by": "", "and by": ""})


def _range_row(plausible_range: PlausibleRange, median: float, sd: float, unit: str) -> dict[str, Any]:
    return {
        "parameter": plausible_range.parameter,
        "unit": printed_unit(unit),
        "lowest": to_printed_unit(plausible_range.standard * plausible_range.lowest.factor, unit),
        "stopped by": plausible_range.lowest.stopped_by,
        "highest": to_printed_unit(plausible_range.standard * plausible_range.highest.factor, unit),
        "and by": plausible_range.highest.stopped_by,
        "X0": to_printed_unit(plausible_range.median, unit),
        "sd (%)": 100 * plausible_range.sd,
        "X0 used": to_printed_unit(median, unit),
        "sd used (%)": 100 * sd,
        "off (sd)": log(median / plausible_range.median) / sd,
    }

"""Tables 1 and 2 in the layout of the paper: a column for each heart, the paper's rows above ours.

Cells are text, rounded as in the paper: two decimals, one less for the mean of a parameter. A parameter below 1 of the
paper's unit has three digits instead, since two decimals would leave none of them. A mark says that a long step of the
heart led to the error, or of the parameter to the estimate.
"""

from collections.abc import Iterator, Mapping, Sequence
from math import floor, isfinite, log10

import numpy as np
import pandas as pd

from heartfit.results.case import CaseResult, Groups, require_one_fingerprint
from heartfit.results.errors import PAPER
from heartfit.results.parameters import healthy_mean
from heartfit.results.text import LONG_STEP_MARK, ROW_HEADINGS

MEAN = "Mean"
"""Heading of the paper above the means."""

PAPER_UNITS = {"Pa": ("MPa", 1e6), "Pa.s": ("MPa.s", 1e6), "Pa.s/m^3": ("MPa.s/m^3", 1e6)}
"""Unit of the paper by SI unit, and its SI value."""
STANDS_IN_FOR = {"c_1": "K"}
"""Parameter that is estimated in place of one of the paper's, and has its row."""

Row = dict[str, str]


def printed_tables(
    cases: Sequence[CaseResult], errors: pd.DataFrame, parameters: pd.DataFrame, groups: Groups
) -> dict[str, pd.DataFrame]:
    """Return both tables by name, beside the paper's ``errors`` and ``parameters``."""
    return {
        "table1_as_printed": printed_errors(cases, errors, groups),
        "table2_as_printed": printed_parameters(cases, parameters, groups),
    }


def printed_errors(cases: Sequence[CaseResult], paper: pd.DataFrame, groups: Groups) -> pd.DataFrame:
    """Return Table 1 as printed, then the unsigned errors [%] of our healthy hearts, one block a setting.

    Our volunteers have the columns 1, 2, ..., in the order of the groups, "Mean" is theirs, and a measured heart has a
    column of its own. paper: observation, 1..7, mean. Raises FingerprintMismatchError for rows of different code.
    """
    require_one_fingerprint(cases)
    names = paper["observation"].tolist()
    rows = [_paper_row(name, row) for name, row in zip(names, paper.to_dict("records"), strict=True)]
    for setting, healthy in _by_setting(cases, groups):
        for name in names:
            errors = {case.case: abs(case.errors()[name]) for case in healthy if name in case.observed}
            of_volunteers = [errors[case] for case in groups.volunteers if isfinite(errors.get(case, np.nan))]
            mean = _decimals(float(np.mean(of_volunteers)), 2) if of_volunteers else ""
            long = [case.case for case in healthy if case.long_steps()]
            cells = {case: _marked(_decimals(error, 2), case in long) for case, error in errors.items()}
            rows.append(_our_row(setting, name, cells, mean, groups))
    return _in_columns(rows, groups)


def printed_parameters(cases: Sequence[CaseResult], paper: pd.DataFrame, groups: Groups) -> pd.DataFrame:
    """Return Table 2 as printed, then the estimates of our healthy hearts in its units, one block a setting.

    Columns as in :func:`printed_errors`; rows in the paper's order, c_1 in the place of K where it is estimated
    instead. paper: parameter, unit, 1..7, mean. Raises FingerprintMismatchError for rows of different code.
    """
    require_one_fingerprint(cases)
    order = paper["parameter"].tolist()
    headings = [f"{row['parameter']} ({row['unit']})" for row in paper.to_dict("records")]
    rows = [_paper_row(name, row) for name, row in zip(headings, paper.to_dict("records"), strict=True)]
    for setting, healthy in _by_setting(cases, groups):
        means = healthy_mean(healthy, groups)
        names = dict.fromkeys(name for case in healthy for name in case.estimate)
        for name in sorted(names, key=lambda name: _place(name, order)):
            estimated = [case for case in healthy if name in case.estimate]
            unit, scale = PAPER_UNITS.get(estimated[0].units[name], (estimated[0].units[name], 1.0))
            typical = means.get(name, estimated[0].estimate[name]) / scale
            digits = _digits(typical)
            cells = {
                case.case: _marked(_decimals(case.estimate[name] / scale, digits), name in case.long_steps())
                for case in estimated
            }
            mean = _decimals(means[name] / scale, digits - 1) if name in means else ""
            rows.append(_our_row(setting, f"{name} ({unit})", cells, mean, groups))
    return _in_columns(rows, groups)


def _by_setting(cases: Sequence[CaseResult], groups: Groups) -> Iterator[tuple[str, Sequence[CaseResult]]]:
    """Yield each setting with its healthy cases, if it has any."""
    for setting in dict.fromkeys(case.setting for case in cases):
        healthy = [case for case in cases if case.setting == setting and case.case in groups.healthy]
        if healthy:
            yield setting, healthy


def _place(name: str, order: Sequence[str]) -> int:
    """Return the row of a parameter among those of the paper, after all of them if it has none."""
    name = STANDS_IN_FOR.get(name, name)
    return order.index(name) if name in order else len(order)


def _digits(value: float) -> int:
    """Return two decimals, or as many as give three digits to a value below one."""
    return max(2, 2 - floor(log10(value)))


def _decimals(value: float, digits: int) -> str:
    return f"{value:.{digits}f}" if isfinite(value) else "failed"


def _marked(text: str, long_step: bool) -> str:
    return f"{text} {LONG_STEP_MARK}" if long_step else text


def _paper_row(heading: str, row: Mapping[str, object]) -> Row:
    numbers = {str(column): f"{value:g}" for column, value in row.items() if isinstance(value, int | float)}
    return {"setting": PAPER, ROW_HEADINGS: heading, **numbers, MEAN: numbers["mean"]}


def _our_row(setting: str, heading: str, cells: Mapping[str, str], mean: str, groups: Groups) -> Row:
    columns = {name: cells.get(name, "") for name in groups.measured}
    numbered = {str(place): cells.get(name, "") for place, name in enumerate(groups.volunteers, start=1)}
    return {"setting": setting, ROW_HEADINGS: heading, **numbered, MEAN: mean, **columns}


def _in_columns(rows: Sequence[Row], groups: Groups) -> pd.DataFrame:
    """Return the rows with the numbered hearts, their mean and the measured hearts in this order."""
    numbers = sorted((column for column in {key for row in rows for key in row} if column.isdigit()), key=int)
    columns = ["setting", ROW_HEADINGS, *numbers, MEAN, *groups.measured]
    return pd.DataFrame(rows, columns=columns).fillna("")

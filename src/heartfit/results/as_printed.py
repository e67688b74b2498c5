"""Tables 1 and 2 in the layout of the paper: a column for each heart, the paper's rows above ours.

Between them stand the parameters that were planted in the virtual volunteers, which an estimate can at best recover.

Cells are text, rounded as in the paper: two decimals, one less for the mean of a parameter. A parameter below 1 of the
paper's unit has three digits instead, since two decimals would leave none of them. A mark says that a long step of the
heart led to the error, or of the parameter to the estimate.
"""

from collections.abc import Iterator, Mapping, Sequence
from math import floor, isfinite, log10

import numpy as np
import pandas as pd

from heartfit.results.card import comparable_truth
from heartfit.results.case import CaseResult, Groups, require_one_fingerprint
from heartfit.results.errors import PAPER
from heartfit.results.text import LONG_STEP_MARK, ROW_HEADINGS

MEAN = "Mean"
"""Heading of the paper above the means."""

PAPER_UNITS = {"Pa": ("MPa", 1e6), "Pa.s": ("MPa.s", 1e6), "Pa.s/m^3": ("MPa.s/m^3", 1e6)}
"""Unit of the paper by SI unit, and its SI value."""
STANDS_IN_FOR = {"c_1": "K"}
"""Parameter that is estimated in place of one of the paper's, and has its row."""

PLANTED, PLANTED_RATIOS = "planted", "planted: the ratios of Table 2"
"""Settings of the rows of true parameters, where the hidden hearts were drawn or have the paper's ratios."""

Row = dict[str, str]
Truths = Mapping[str, Mapping[str, float]]


def printed_tables(
    cases: Sequence[CaseResult],
    errors: pd.DataFrame,
    parameters: pd.DataFrame,
    groups: Groups,
    truths: Truths,
    planted_ratios: bool,
) -> dict[str, pd.DataFrame]:
    """Return both tables by name, with the paper's ``errors`` and ``parameters``."""
    return {
        "table1_as_printed": printed_errors(cases, errors, groups),
        "table2_as_printed": printed_parameters(cases, parameters, groups, truths, planted_ratios),
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


def printed_parameters(
    cases: Sequence[CaseResult],
    paper: pd.DataFrame,
    groups: Groups,
    truths: Truths | None = None,
    planted_ratios: bool = True,
) -> pd.DataFrame:
    """Return Table 2 as printed, what was planted, and the estimates of our healthy hearts, one block a setting.

    Columns as in :func:`printed_errors`, units of the paper; rows in its order, c_1 in the place of K where it is
    estimated instead. paper: parameter, unit, 1..7, mean; truths: parameters of the virtual volunteers, by case, SI;
    planted_ratios: they have the ratios of the paper. Raises FingerprintMismatchError for rows of different code.
    """
    require_one_fingerprint(cases)
    order = paper["parameter"].tolist()
    headings = [f"{row['parameter']} ({row['unit']})" for row in paper.to_dict("records")]
    rows = [_paper_row(name, row) for name, row in zip(headings, paper.to_dict("records"), strict=True)]
    units = {name: unit for case in cases for name, unit in case.units.items()}
    known = [name for name in units if _place(name, order) < len(order)]
    planted = _planted(groups, truths or {}, known)
    rows += _block(PLANTED_RATIOS if planted_ratios else PLANTED, planted, units, {}, order, groups)
    for setting, healthy in _by_setting(cases, groups):
        estimates = {case.case: case.estimate for case in healthy}
        long = {case.case: case.long_steps() for case in healthy}
        rows += _block(setting, estimates, units, long, order, groups)
    return _in_columns(rows, groups)


def _planted(groups: Groups, truths: Truths, names: Sequence[str]) -> dict[str, dict[str, float]]:
    """Return the true values of the named parameters of each virtual volunteer, where they can be compared."""
    return {
        case: {name: value for name, value in comparable_truth(truths[case]).items() if name in names}
        for case in groups.volunteers
        if case in truths
    }


def _block(
    setting: str,
    values: Truths,
    units: Mapping[str, str],
    long: Mapping[str, Mapping[str, float]],
    order: Sequence[str],
    groups: Groups,
) -> Iterator[Row]:
    """Yield a row for each parameter of the hearts' values [SI], the long steps among them marked."""
    names = dict.fromkeys(name for of_heart in values.values() for name in of_heart)
    for name in sorted(names, key=lambda name: _place(name, order)):
        hearts = {case: of_heart[name] for case, of_heart in values.items() if name in of_heart}
        unit, scale = PAPER_UNITS.get(units[name], (units[name], 1.0))
        of_volunteers = [value for case, value in hearts.items() if case in groups.volunteers]
        digits = _digits(float(np.mean(of_volunteers or list(hearts.values())[:1])) / scale)
        cells = {
            case: _marked(_decimals(value / scale, digits), name in long.get(case, {}))
            for case, value in hearts.items()
        }
        mean = _decimals(float(np.mean(of_volunteers)) / scale, digits - 1) if of_volunteers else ""
        yield _our_row(setting, f"{name} ({unit})", cells, mean, groups)


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

"""Table 3: patients, whose pressure is measured too, and the results of the paper for its patients."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import pandas as pd

from heartfit.core.parameter import DISPLAY
from heartfit.results.card import comparable_truth
from heartfit.results.case import CaseResult, Groups, require_one_fingerprint
from heartfit.results.errors import PAPER, mean_error
from heartfit.results.parameters import healthy_mean
from heartfit.results.text import LONG_STEP_MARK, LONG_STEPS, printed_steps

Row = dict[str, Any]
PAPER_CASES = ("1", "2")  # of the paper's LBBB cases


def patient_errors(cases: Sequence[CaseResult], paper: pd.DataFrame, groups: Groups) -> pd.DataFrame:
    """Return one row per observation of each patient and setting and their mean, then the mean of the paper.

    "below noise" marks errors without meaning, z < 1. paper: quantity, unit, 1, 2,
    healthy_mean. Raises FingerprintMismatchError for rows of different code.
    """
    require_one_fingerprint(cases)
    rows = [row for case in _patients(cases, groups) for row in _error_rows(case)]
    return pd.DataFrame([*rows, *_paper_error_rows(paper)])


def patient_parameters(
    cases: Sequence[CaseResult],
    paper: pd.DataFrame,
    groups: Groups,
    truths: Mapping[str, Mapping[str, float]] | None = None,
) -> pd.DataFrame:
    """Return one row per estimated parameter of each patient and setting, with the mean of the virtual volunteers.

    truths: by case, SI; "true over healthy mean" is the ratio of the truths, the target of both settings. A limit that
    the paper gives for a parameter stays a limit. Raises FingerprintMismatchError for rows of different code.
    """
    require_one_fingerprint(cases)
    means = {
        case.setting: healthy_mean([other for other in cases if other.setting == case.setting], groups)
        for case in cases
    }
    true_values = {name: comparable_truth(truth) for name, truth in (truths or {}).items()}
    true_means = pd.DataFrame(
        [truth for name, truth in true_values.items() if name in groups.volunteers]
    ).mean()
    rows = [
        _parameter_row(case, name, means[case.setting], true_values.get(case.case, {}), true_means.to_dict())
        for case in _patients(cases, groups)
        for name in case.estimate
    ]
    return pd.DataFrame([*rows, *_paper_parameter_rows(paper)])


def _patients(cases: Sequence[CaseResult], groups: Groups) -> list[CaseResult]:
    """Return the results of the patients, one setting after the other."""
    settings = dict.fromkeys(case.setting for case in cases)
    return [
        case
        for setting in settings
        for case in cases
        if case.setting == setting and case.case in groups.diseased
    ]


def _error_rows(case: CaseResult) -> Iterable[Row]:
    errors, floor, scores, prior = case.errors(), case.floor(), case.scores(), case.reference_errors()
    for name, error in errors.items():
        yield {
            "setting": case.setting,
            "case": case.case,
            "quantity": name,
            "error (%)": abs(error),
            "prior error (%)": abs(prior[name]),
            "floor (%)": floor[name],
            "z": abs(scores[name]),
            "below noise": "yes" if abs(scores[name]) < 1.0 else "",
            LONG_STEPS: printed_steps(case.long_steps()),
        }
    yield {
        "setting": case.setting,
        "case": case.case,
        "quantity": "mean",
        "error (%)": mean_error(errors),
        "prior error (%)": mean_error(prior),
        "below noise": "",
        LONG_STEPS: printed_steps(case.long_steps()),
    }


def _paper_error_rows(paper: pd.DataFrame) -> list[Row]:
    row = paper.set_index("quantity").loc["mean error"]
    return [
        {
            "setting": PAPER,
            "case": f"LBBB case {number}",
            "quantity": "mean",
            "error (%)": float(row[number]),
            "below noise": "",
            LONG_STEPS: "",
        }
        for number in PAPER_CASES
    ]


def _parameter_row(
    case: CaseResult,
    name: str,
    mean: Mapping[str, float],
    truth: Mapping[str, float],
    true_means: Mapping[str, float],
) -> Row:
    unit, scale = DISPLAY.get(case.units[name], (case.units[name], 1.0))
    healthy = mean.get(name, float("nan"))
    return {
        "setting": case.setting,
        "case": case.case,
        "quantity": name,
        "unit": unit,
        "value": case.estimate[name] / scale,
        "sd (%)": 100 * case.estimate_sd[name],
        "healthy mean": healthy / scale,
        "step (prior sd)": case.steps()[name],
        LONG_STEPS: LONG_STEP_MARK if name in case.long_steps() else "",
        "over healthy mean": case.estimate[name] / healthy,
        "true over healthy mean": truth[name] / true_means[name]
        if name in truth and name in true_means
        else float("nan"),
    }


def _paper_parameter_rows(paper: pd.DataFrame) -> list[Row]:
    rows = [row for _, row in paper[paper["healthy_mean"].notna()].iterrows()]
    return [
        {
            "setting": PAPER,
            "case": f"LBBB case {number}",
            "quantity": row["quantity"],
            "unit": row["unit"],
            "value": row[number],
            LONG_STEPS: "",
            "healthy mean": row["healthy_mean"],
            "over healthy mean": _ratio(row[number], row["healthy_mean"]),
        }
        for number in PAPER_CASES
        for row in rows
        if isinstance(row[number], str)
    ]


def _ratio(value: str, mean: float) -> str:
    """Return the ratio of a printed value to a mean: "<0.69" for "<4" over 5.8."""
    limit = "<" if value.startswith("<") else ""
    return f"{limit}{float(value.removeprefix('<')) / mean:.2f}"

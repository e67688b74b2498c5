"""Claims of the paper, one row per number that it states, with ours and a verdict.

The claims are rows of resources/marchesseau2012/claims.tsv; `heartfit.results.findings` computes our numbers.
"""

from collections.abc import Callable, Mapping, Sequence
from math import isfinite, log10
from typing import Any

import numpy as np
import pandas as pd

from heartfit.core.errors import InputError
from heartfit.results.as_printed import PAPER_UNITS
from heartfit.results.case import DILATED
from heartfit.results.findings import (
    SLOPES,
    Finding,
    Source,
    StudyResults,
    analysed_parameters,
    errors_of,
    estimates_of,
    from_costs,
    minutes,
    number_of_hearts,
    number_of_priors,
    over_healthy_mean,
    over_hearts,
    registration_error,
    registration_over_calibration,
    selected,
    updates,
)
from heartfit.results.specificity_table import STIFFNESS, ClaimedLimits
from heartfit.results.text import LONG_STEPS

OBSERVATIONS, PARAMETERS = ("V_min", *SLOPES), ("sigma_0", "mu", "K", "R_p")
"""Rows of the paper's Tables 1 and 2."""


def _spread(values: Sequence[float]) -> float:
    return max(values) / min(values)


FINDINGS: dict[str, Source] = {
    "estimated_parameters": over_hearts("all", lambda cases: max(len(case.estimate) for case in cases)),
    "iterations": from_costs(updates),
    "volunteers": number_of_hearts("healthy"),
    "patients": number_of_hearts("patients"),
    "mean_error": over_hearts("all", errors_of(np.mean), with_steps=True),
    "model_parameters": analysed_parameters,
    "parameters_of_volume": over_hearts("healthy", lambda cases: max(len(case.estimate) for case in cases)),
    "parameters_of_pressure": over_hearts(
        "patients", lambda cases: max(len(case.estimate) for case in cases)
    ),
    "selection_of_volume": selected("volume"),
    "selection_of_pressure": selected("volume and pressure"),
    "simulations_of_volume": over_hearts("healthy", lambda cases: max(case.sigma_points for case in cases)),
    "simulations_of_pressure": over_hearts(
        "patients", lambda cases: max(case.sigma_points for case in cases)
    ),
    "priors": over_hearts("all", number_of_priors),
    "minutes": from_costs(minutes),
    **{
        f"mean_{name}": over_hearts("healthy", errors_of(np.mean, name), with_steps=True)
        for name in OBSERVATIONS
    },
    **{
        f"largest_{name}": over_hearts("healthy", errors_of(max, name), with_steps=True)
        for name in OBSERVATIONS
    },
    **{f"mean_{name}": estimates_of(name, np.mean) for name in PARAMETERS},
    **{f"spread_{name}": estimates_of(name, _spread) for name in PARAMETERS},
    "patients_error": over_hearts("patients", errors_of(np.mean), with_steps=True),
    "K_of_dilated": estimates_of("K", max, "patients", DILATED),
    "stiffness_of_dilated": over_healthy_mean(STIFFNESS, DILATED),
    "sigma_0_of_patients": estimates_of("sigma_0", max, "patients"),
    "contractility_of_patients": over_healthy_mean(("sigma_0",)),
    "registration_q_max": registration_error("q_max"),
    "registration_q_min": registration_error("q_min"),
    "registration_over_calibration": registration_over_calibration,
}
"""Source of our numbers by claim."""

MET, NOT_MET, INCOMPARABLE = "met", "not met", "not comparable"

RELATIONS: dict[str, Callable[[float, float], bool]] = {
    "at most": lambda ours, paper: ours <= paper,
    "below": lambda ours, paper: ours < paper,
    "at least": lambda ours, paper: ours >= paper,
    "equal": lambda ours, paper: ours == paper,
    "same order": lambda ours, paper: abs(log10(ours / paper)) < 1.0,
}
"""Relation of our number to the paper's that meets a claim."""

SCALES = {unit: scale for unit, scale in PAPER_UNITS.values()}
"""SI value of the units of the paper."""
NO_RESULT = "this study has no such hearts"


def claims_table(claims: pd.DataFrame, results: StudyResults) -> pd.DataFrame:
    """Return the claims in the order of the resource, one row per setting and group of hearts of ours.

    claims: claim, place, quote, quantity, printed, value, unit, relation, incomparable, planted. "ours" has three
    digits; verdict: met, not met, or not comparable with the reason. Raises InputError for a claim that nothing is
    computed for, or an unknown relation.
    """
    rows = [row for claim in claims.fillna("").to_dict("records") for row in _rows(claim, results)]
    return pd.DataFrame(rows)


def claimed_limits(claims: pd.DataFrame) -> ClaimedLimits:
    """Return the paper's two limits for its patients over the healthy mean."""
    values = claims.set_index("claim")["value"]
    return ClaimedLimits(
        weak=float(values["contractility_of_patients"]), stiff=float(values["stiffness_of_dilated"])
    )


def _rows(claim: Mapping[Any, Any], results: StudyResults) -> Sequence[dict[str, str]]:
    name, relation = claim["claim"], claim["relation"]
    if name not in FINDINGS or relation not in RELATIONS:
        raise InputError(
            f"claims: {name} with the relation {relation!r}; expected one of {', '.join(FINDINGS)} and one of "
            f"{', '.join(RELATIONS)}"
        )
    stated = {
        "place": claim["place"],
        "quote": claim["quote"],
        "quantity": claim["quantity"],
        "paper": claim["printed"],
        "unit": claim["unit"],
    }
    findings = list(FINDINGS[name](results)) or [Finding("", "", float("nan"), NO_RESULT)]
    return [
        stated
        | {
            "setting": finding.setting,
            "hearts": finding.hearts,
            "ours": _printed(finding.value / SCALES.get(claim["unit"], 1.0)),
            "verdict": _verdict(finding, claim, results.planted_ratios),
            LONG_STEPS: finding.long_steps,
        }
        for finding in findings
    ]


def _printed(value: float) -> str:
    """Return a number with three digits, whole from 100 on; empty without a number."""
    if not isfinite(value):
        return ""
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.3g}"


def _verdict(finding: Finding, claim: Mapping[Any, Any], planted_ratios: bool) -> str:
    circular = claim["planted"] if planted_ratios else ""
    reason = claim["incomparable"] or circular or finding.incomparable
    if reason:
        return f"{INCOMPARABLE}: {reason}"
    ours = finding.value / SCALES.get(claim["unit"], 1.0)
    return MET if RELATIONS[claim["relation"]](ours, float(claim["value"])) else NOT_MET

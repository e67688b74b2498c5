"""What sets patients apart, with exact p, how much of it the data see, and whether the paper's claims hold."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import pandas as pd

from heartfit.calibration.information import SEEN
from heartfit.tables.groups import DILATED
from heartfit.tables.specificity import READINGS, STANDS_FOR, Comparison

WEAK, STIFF = 0.7, 1.4
"""The paper's claims as ratios to the healthy mean: contractility of both patients below, stiffness of case 2 above."""

STIFFNESS = (*STANDS_FOR, *STANDS_FOR.values())
Row = dict[str, Any]


def specificity_table(comparisons: Sequence[Comparison]) -> pd.DataFrame:
    """One row per setting, parameter and reading: each patient over the healthy mean, and the exact test of ln.

    "difference" is in prior standard deviations; p is two-sided over all labelings, "least p" the smallest that they
    allow; "seen" the share of the prior's variance of the difference that the data took away, of all parameters
    together the share of the squared difference that lies in what the data inform. Below one half there is a warning.
    """
    return pd.DataFrame([row for each in comparisons for row in (*_parameters(each), *_together(each))])


def claims_table(comparisons: Sequence[Comparison]) -> pd.DataFrame:
    """The paper's claims, one row per setting and reading: the ratio that decides, its limit, p in its direction."""
    return pd.DataFrame([row for each in comparisons for row in (*_weak(each), *_stiff(each))])


def _parameters(each: Comparison) -> Iterable[Row]:
    for place, name in enumerate(each.names):
        seen = 1.0 - float(each.seen.sd_ratio[place]) ** 2
        for reading in READINGS:
            ratios = each.ratios(reading, name)
            if ratios:
                test = each.test(reading, name)
                yield {
                    "setting": each.setting,
                    "parameter": name,
                    "reading": reading,
                    **{f"{card.case} over healthy": ratios[card.case] for card in each.patients},
                    "difference": test.difference
                    / float(np.sqrt(each.patients[0].prior.marginal([name]).covariance[0, 0])),
                    "p": test.p,
                    "least p": 1.0 / test.labelings,
                    "seen": seen,
                    "warning": _warning(seen),
                }


def _together(each: Comparison) -> Iterable[Row]:
    for reading in READINGS:
        if all(each.ratios(reading, name) for name in each.names):
            difference = each.difference(reading)
            seen = each.seen.share(difference)
            yield {
                "setting": each.setting,
                "parameter": "all",
                "reading": reading,
                "difference": float(np.linalg.norm(difference)),
                "seen": seen,
                "warning": _warning(seen),
            }


def _warning(seen: float) -> str:
    return "" if seen >= SEEN else "the prior's more than the data's"


def _weak(each: Comparison) -> Iterable[Row]:
    if "sigma_0" in each.names:
        who = [card.case for card in each.patients]
        for reading in READINGS:
            ratios, test = each.ratios(reading, "sigma_0"), each.test(reading, "sigma_0")
            worst = max(ratios[case] for case in who)
            claim = f"sigma_0 of {' and '.join(who)} below"
            yield _claim(each, claim, reading, worst, WEAK, worst < WEAK, test.less, test.labelings)


def _stiff(each: Comparison) -> Iterable[Row]:
    name = next((name for name in STIFFNESS if name in each.names), None)
    if name and DILATED in [card.case for card in each.patients]:
        for reading in READINGS:
            ratio, test = each.ratios(reading, name)[DILATED], each.test(reading, name, [DILATED])
            claim = f"{name} of {DILATED} above"
            yield _claim(each, claim, reading, ratio, STIFF, ratio > STIFF, test.greater, test.labelings)


def _claim(
    each: Comparison,
    claim: str,
    reading: str,
    ratio: float,
    limit: float,
    holds: bool,
    p: float,
    labelings: int,
) -> Row:
    return {
        "setting": each.setting,
        "claim": claim,
        "reading": reading,
        "over healthy": ratio,
        "limit": limit,
        "holds": "holds" if holds else "does not hold",
        "p": p,
        "least p": 1.0 / labelings,
    }

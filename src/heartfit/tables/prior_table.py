"""X0 and C_X from the plausible ranges, beside what the study uses."""

from collections.abc import Mapping
from math import log
from typing import Any

import pandas as pd

from heartfit.sensitivity.covariance import Sensitivity
from heartfit.sensitivity.plausible import Plausible, PlausibleRange
from heartfit.tables.display import printed, printed_unit


def prior_table(
    ranges: Mapping[str, Plausible], found: Mapping[str, Sensitivity], units: Mapping[str, str]
) -> pd.DataFrame:
    """By setting and parameter: lowest and highest plausible value, what stops it, X0 and sd by the rule and as used.

    "off (sd)": how far the X0 in use is from the rule's, in its own standard deviations. A last row of a setting names
    the quantities whose limits the standard beat itself does not keep, so that they stop no parameter.
    """
    rows: list[dict[str, Any]] = []
    for setting, plausible in ranges.items():
        used = found[setting].prior
        medians = used.physical()
        for one, sd in zip(plausible.ranges, used.sd.tolist(), strict=True):
            rows.append({"setting": setting, **_row(one, medians[one.parameter], sd, units[one.parameter])})
        if plausible.broken:
            rows.append({"setting": setting, "parameter": f"not kept: {', '.join(plausible.broken)}"})
    return pd.DataFrame(rows).fillna({"unit": "", "stopped by": "", "and by": ""})


def _row(one: PlausibleRange, median: float, sd: float, unit: str) -> dict[str, Any]:
    return {
        "parameter": one.parameter,
        "unit": printed_unit(unit),
        "lowest": printed(one.standard * one.lowest.factor, unit),
        "stopped by": one.lowest.stopped_by,
        "highest": printed(one.standard * one.highest.factor, unit),
        "and by": one.highest.stopped_by,
        "X0": printed(one.median, unit),
        "sd (%)": 100 * one.sd,
        "X0 used": printed(median, unit),
        "sd used (%)": 100 * sd,
        "off (sd)": log(median / one.median) / sd,
    }

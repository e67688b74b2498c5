"""What was named of each case, beside what was planted: the evaluation of search and proof."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from heartfit.tables.cause_card import UNITS

GAINS = {
    "lv_volume": "LV volume ratio",
    "lv_pressure": "LV pressure ratio",
    "rv_volume": "RV volume ratio",
    "circumferential strain": "strain ratio",
}


@dataclass(frozen=True)
class Proved:
    """One case: its cause.json, the parameters before and after the extension, and what only an evaluation may know.

    planted: name, amplitude, SI, and its unit, of what a virtual case hides; truth: its parameters, SI.
    """

    case: str
    setting: str
    cause: Mapping[str, Any]
    before: Mapping[str, float]
    after: Mapping[str, float]
    planted: Sequence[tuple[str, float, str]]
    truth: Mapping[str, float]

    def bias(self, found: Mapping[str, float]) -> float:
        """Root mean square of ln(found / true), in percent, over the parameters that the truth knows."""
        known = [name for name in self.before if name in self.truth and name != "K"]
        apart = [np.log(found[name] / self.truth[name]) for name in known]
        return 100.0 * float(np.sqrt(np.mean(np.square(apart)))) if apart else float("nan")


def discovery_table(cases: Sequence[Proved]) -> pd.DataFrame:
    """One row per case: planted, said, sizes, held-out error ratios and the bias of the parameters, in percent.

    A ratio below one says that the extension helps where nothing was fitted. K has no true value.
    """
    return pd.DataFrame([_row(each) for each in cases])


def _row(each: Proved) -> dict[str, Any]:
    named = each.cause["mechanisms"]
    ratios = {gain["curve"]: gain["ratio"] for gain in each.cause["gain"]}
    return {
        "case": each.case,
        "setting": each.setting,
        "planted": ", ".join(f"{name} {_printed(value, unit)}" for name, value, unit in each.planted),
        "verdict": each.cause["verdict"],
        "named": ", ".join(_named(cause) for cause in named),
        "ln BF": named[0]["ln_bayes_factor"] if named else max(each.cause["ranking"].values()),
        "best of the ranking": max(each.cause["ranking"], key=each.cause["ranking"].__getitem__),
        **{column: ratios.get(curve, float("nan")) for curve, column in GAINS.items()},
        "bias before (%)": each.bias(each.before),
        "bias after (%)": each.bias(each.after),
        "beats": each.cause["simulations"],
    }


def _named(cause: Mapping[str, Any]) -> str:
    value, low, high = (_printed(each, cause["unit"]) for each in (cause["amplitude"], *cause["interval"]))
    return f"{cause['name']} {value} ({low} to {high})"


def _printed(value: float, unit: str) -> str:
    printed, factor = UNITS.get(unit, (unit, 1.0))
    return f"{factor * value:.2g} {printed}".strip()

"""What a case's model gains by each mechanism that was tried, where nothing was fitted."""

from collections.abc import Mapping, Sequence

import pandas as pd

from heartfit.diagnosis.cause import Attempt, Gain
from heartfit.tables.cause_card import UNITS, spoken

JUDGES = {
    "lv_volume": "LV volume, other frames",
    "lv_pressure": "LV pressure, other 40 ms",
    "rv_volume": "RV volume",
    "circumferential strain": "circumferential strain",
    "longitudinal strain": "longitudinal strain",
}


def by_gain(attempts: Sequence[Attempt]) -> list[Attempt]:
    """Those that predict the other frames of the left volume best come first."""
    return sorted(attempts, key=lambda each: gains_of(each)["lv_volume"].ratio)


def gains_of(attempt: Attempt) -> Mapping[str, Gain]:
    """The gains by what judged."""
    return {gain.curve: gain for gain in attempt.gain}


def attempts_table(attempts: Sequence[Attempt]) -> pd.DataFrame:
    """One row per mechanism: its size, the evidence of the refits, and error ratios, below one where it helps."""
    return pd.DataFrame([_row(each) for each in by_gain(attempts)])


def _row(attempt: Attempt) -> dict[str, str | float]:
    (size,) = attempt.refitted.extension
    unit, factor = UNITS.get(size.unit, (size.unit, 1.0))
    values = [f"{factor * each:.3g}" for each in (size.amplitude, *size.interval)]
    return {
        "mechanism": spoken(size.name),
        "size": f"{values[0]} ({values[1]} to {values[2]}) {unit}".strip(),
        "ln BF": f"{attempt.refitted.ln_bayes_factor:.1f}",
        **{JUDGES[gain.curve]: _ratio(gain) for gain in attempt.gain},
        "at rest": "yes" if attempt.refitted.converged else "no",
        "beats": attempt.refitted.simulations,
    }


def _ratio(gain: Gain) -> str:
    return f"{gain.ratio:.2f} ({gain.interval[0]:.2f} to {gain.interval[1]:.2f})"

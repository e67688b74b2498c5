"""Whether it is the element or the patient: rivals that were fitted to the same data, as a table."""

from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from heartfit.diagnosis.rivals import Rival


def element_table(rivals: Sequence[Rival], hidden: Mapping[str, float]) -> pd.DataFrame:
    """One row per rival, the first of which is none; parameters over the ``hidden`` values, SI, in percent."""
    return pd.DataFrame([_row(each, rivals[0], hidden) for each in rivals])


def _row(rival: Rival, none: Rival, hidden: Mapping[str, float]) -> dict[str, Any]:
    ratios = {f"{gain.curve}, error ratio": _ratio(gain.ratio, gain.interval) for gain in rival.gains}
    off = {f"{name} (%)": 100.0 * (rival.parameters[name] / value - 1.0) for name, value in hidden.items()}
    return {
        "explanation": rival.name,
        "ln Bayes factor": rival.log_evidence - none.log_evidence,
        f"misfit of {rival.samples}": rival.misfit,
        **ratios,
        **off,
        "beats": rival.simulations,
    }


def _ratio(ratio: float, interval: tuple[float, float]) -> str:
    low, high = interval
    return f"{ratio:.2f} ({low:.2f} to {high:.2f})"

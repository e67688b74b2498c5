"""What no observation holds and must be believed all the same: the guards of every calibrated beat."""

from collections.abc import Sequence
from typing import Any

import pandas as pd

from heartfit.tables.case import CaseResult
from heartfit.tables.fingerprints import require_one_fingerprint


def plausibility_table(cases: Sequence[CaseResult]) -> pd.DataFrame:
    """One row per case and setting: volumes that were not fitted, pressures, wall, and how periodic the beat is.

    Errors are signed percentages; EDV and ESV are the largest and the least volume. A beat that failed has empty
    cells. Raises FingerprintMismatchError for rows of different code.
    """
    require_one_fingerprint(cases)
    return pd.DataFrame([_row(case) for case in cases])


def _row(case: CaseResult) -> dict[str, Any]:
    seen = case.guards
    row: dict[str, Any] = {"setting": case.setting, "case": case.case}
    for side in ("lv", "rv"):
        for index in ("EDV", "ESV"):
            row[f"{side.upper()} {index} (%)"] = seen.get(f"{side}_{index}_error_percent")
        row[f"{side.upper()} peak (kPa)"] = _scaled(seen.get(f"{side}_peak_pressure"), 1e-3)
    return row | {
        "wall volume loss (%)": _scaled(seen.get("wall_volume_loss"), 100.0),
        "beats": seen.get("beats"),
        "drift (%)": _scaled(seen.get("drift"), 100.0),
        "trigger shift (ms)": 1e3 * case.shift,
        "notes": "; ".join(case.notes),
    }


def _scaled(value: float | None, factor: float) -> float | None:
    return None if value is None else factor * value

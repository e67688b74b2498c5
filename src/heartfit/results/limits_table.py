"""Table of the detection limits."""

from collections.abc import Iterable

import pandas as pd

from heartfit.discovery.sphere_model.limits import SIZES, DetectionLimit
from heartfit.results.planted_table import UNITS


def limits_table(limits: Iterable[DetectionLimit]) -> pd.DataFrame:
    """Return one row for each effect: its detection limit in its unit and in scales, and ln Bayes factors by size."""
    return pd.DataFrame([_row(limit) for limit in limits])


def _row(limit: DetectionLimit) -> dict[str, str]:
    sign = {True: "", False: "+" if limit.sign > 0.0 else "-"}[limit.switch.one_sided]
    return {
        "effect": f"{limit.name} {sign}".strip(),
        "detection limit": _printed(limit),
        "in scales": f"> {SIZES[-1]:g}" if limit.least is None else f"{limit.least:.1f}",
        **{f"ln BF at {size:g}": f"{x:.1f}" for size, x in zip(SIZES, limit.factors, strict=True)},
    }


def _printed(limit: DetectionLimit) -> str:
    """Return the amplitude in the printed unit; "not seen" for an effect below detection at the largest size."""
    if limit.amplitude is None:
        return "not seen"
    unit, factor = UNITS.get(limit.switch.unit, (limit.switch.unit, 1.0))
    return f"{abs(limit.amplitude - (limit.switch.off or 0.0)) / factor:.2g} {unit}".strip()

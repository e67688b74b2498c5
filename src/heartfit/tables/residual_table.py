"""Residuals of a case, sample by sample, and in one sentence."""

import numpy as np
import pandas as pd

from heartfit.observation.beat_phases import BeatPhases
from heartfit.observation.residual import CaseResidual, Misfit, Residual
from heartfit.observation.strain import DIRECTIONS, SEGMENTS
from heartfit.observation.strain_residual import StrainResidual

NAMES = {
    "lv_volume": "LV volume",
    "rv_volume": "RV volume",
    "lv_pressure": "LV pressure",
    "aorta_pressure": "aortic pressure",
}
WALLS = ("anterior", "anteroseptal", "inferoseptal", "inferior", "inferolateral", "anterolateral")
APICAL = ("anterior", "septal", "inferior", "lateral")
AHA = [
    *(f"{level} {wall}" for level in ("basal", "mid") for wall in WALLS),
    *(f"apical {wall}" for wall in APICAL),
]
"""Names of the segments 1 to 16 (Cerqueira et al. 2002, doi 10.1161/hc0402.102975)."""
COLUMNS = ["curve", "beat", "time (s)", "phase", "unit", "difference", "noise", "score"]
UNITS = {"volume": ("mL", 1e-6), "pressure": ("kPa", 1e3)}
"""Printed unit and what one of it is in SI."""


def unit_of(curve: str) -> tuple[str, float]:
    """Printed unit of a curve by name, and its SI value."""
    return UNITS[curve.rsplit("_", 1)[1]]


def residual_table(residual: CaseResidual) -> pd.DataFrame:
    """One row per sample and beat, then one per segment and direction of the strain at end systole.

    Volumes in mL, pressures in kPa, strain in percent; score: difference over noise, which is empty where nobody has
    measured it. No rows if no beat was completed.
    """
    if residual.phases is None:
        return pd.DataFrame(columns=COLUMNS)
    rows = [_curve_rows(each, residual.phases, beat) for each in residual.curves for beat in each.simulated]
    if residual.strain is not None:
        rows.append(_strain_rows(residual.strain, residual.phases, residual.label))
    return pd.concat(rows)[COLUMNS]


def _curve_rows(residual: Residual, phases: BeatPhases, beat: str) -> pd.DataFrame:
    unit, size = unit_of(residual.curve)
    return pd.DataFrame(
        {
            "curve": residual.curve,
            "beat": beat,
            "time (s)": residual.times,
            "phase": phases.at(residual.times),
            "unit": unit,
            "difference": residual.difference(beat) / size,
            "noise": residual.noise / size,
            "score": residual.score(beat),
        }
    )


def _strain_rows(strain: StrainResidual, phases: BeatPhases, beat: str) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "curve": [
                f"{direction} strain, segment {segment}" for direction in DIRECTIONS for segment in SEGMENTS
            ],
            "beat": beat,
            "time (s)": strain.time,
            "phase": phases.at(np.array([strain.time]))[0],
            "unit": "%",
            "difference": 100.0 * strain.difference.ravel(),
            "noise": np.nan if strain.noise is None else 100.0 * strain.noise.ravel(),
            "score": np.nan if strain.noise is None else strain.score().ravel(),
        }
    )


def sentence(worst: Misfit) -> str:
    """ "LV volume in early filling: simulated 8.2 mL too large (3.1 times its noise)"."""
    unit, size = unit_of(worst.curve)
    sign = "large" if worst.difference > 0 else "small"
    return (
        f"{NAMES[worst.curve]} in {worst.phase}: simulated {abs(worst.difference) / size:.1f} {unit} too {sign} "
        f"({abs(worst.score):.1f} times its noise)"
    )


def segment_sentence(strain: StrainResidual) -> str:
    """ "segment 16, apical lateral, shortens too much by 10 % of its length (3.1 times its noise)": the worst one."""
    scores = strain.score()[DIRECTIONS.index("circumferential")]
    worst = int(np.abs(scores).argmax())
    difference = 100.0 * strain.difference[DIRECTIONS.index("circumferential"), worst]
    way = "much" if difference < 0.0 else "little"
    noise = "" if strain.noise is None else f" ({abs(scores[worst]):.1f} times its noise)"
    size = f"{abs(difference):.0f} % of its length{noise}"
    return f"segment {SEGMENTS[worst]}, {AHA[worst]}, shortens too {way} by {size}"

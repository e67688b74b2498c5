"""What was observed of a case and what its beats show, as rows of words and printed numbers."""

import math
from dataclasses import dataclass

from heartfit.report.record import CaseRecord, Fit
from heartfit.tables.display import printed, printed_unit

ML = 1e-6
UNITS = {
    "V_min": "m^3",
    "q_max": "m^3/s",
    "q_min": "m^3/s",
    "P_max": "Pa",
    "dPdt_max": "Pa/s",
    "dPdt_min": "Pa/s",
}


@dataclass(frozen=True)
class Observed:
    """One observation in its printed unit; error and noise in percent, and the one over the other."""

    name: str
    unit: str
    measured: float
    prior: float
    calibrated: float
    error: float
    floor: float
    score: float


def observations(fit: Fit) -> list[Observed]:
    """Those of a case under a setting, NaN where the beat failed."""
    result = fit.result
    errors, floor, scores = result.errors(), result.floor(), result.scores()
    return [
        Observed(
            name,
            printed_unit(UNITS[name]),
            printed(value, UNITS[name]),
            printed(result.reference.get(name, math.nan), UNITS[name]),
            printed(result.calibrated.get(name, math.nan), UNITS[name]),
            errors[name],
            floor[name],
            scores[name],
        )
        for name, value in result.observed.items()
    ]


def facts(case: CaseRecord) -> list[str]:
    """A case in a line: whose, how activated, how large."""
    kind = {"measured": "measured heart", "virtual": "virtual heart, truth known"}[case.kind]
    conduction = {"healthy": "healthy conduction", "lbbb": "left bundle branch block"}[case.conduction]
    volume = case.measured["lv_volume"].values
    largest, least = float(volume.max()) / ML, float(volume.min()) / ML
    return [
        kind,
        conduction,
        f"beat of {1e3 * case.registered.period:.0f} ms in {len(case.registered.times)} phases",
        f"left ventricle {largest:.0f} to {least:.0f} mL, ejection fraction {100 * (1 - least / largest):.0f} %",
        "pressure recorded" if "lv_pressure" in case.measured else "no pressure recorded",
        f"{len(case.mesh.tets)} tetrahedra",
    ]


def status(fit: Fit) -> str:
    """What became of a calibration, honestly and in few words."""
    if not fit.completed:
        return "calibrated beat failed"
    lost = fit.result.failed_points
    said = [f"{lost} of {fit.result.sigma_points} points failed"] if lost else []
    said += ["long step"] if any("beyond 3" in note for note in fit.result.notes) else []
    return ", ".join(["calibrated", *said])

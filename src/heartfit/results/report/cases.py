"""Observations, facts and status of a case as rows of words and printed numbers, and the curves of the cohort."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from matplotlib import rc_context
from matplotlib.axes import Axes

from heartfit.core.parameter import printed_unit, to_printed_unit
from heartfit.results.figures import MEASURED, clean
from heartfit.results.report.curves import samples, simulated
from heartfit.results.report.picture import TEXT, Picture, as_picture, grid, legend
from heartfit.results.report.record import CaseRecord, FittedCase
from heartfit.results.text import LONG_STEP_MARK
from heartfit.study.case import CASE_KINDS

ML = 1e-6
UNITS = {
    "V_min": "m^3",
    "q_max": "m^3/s",
    "q_min": "m^3/s",
    "P_max": "Pa",
    "dPdt_max": "Pa/s",
    "dPdt_min": "Pa/s",
    "V_min_rv": "m^3",
    "q_max_rv": "m^3/s",
    "q_min_rv": "m^3/s",
}


@dataclass(frozen=True)
class Observed:
    """One observation in its printed unit; error and noise [%], and error over noise."""

    name: str
    unit: str
    measured: float
    prior: float
    calibrated: float
    error: float
    floor: float
    score: float


def observations(fit: FittedCase) -> list[Observed]:
    """Return the observations of a case under a setting, NaN for a failed beat."""
    result = fit.result
    errors, floor, scores = result.errors(), result.floor(), result.scores()
    return [
        Observed(
            name,
            printed_unit(UNITS[name]),
            to_printed_unit(value, UNITS[name]),
            to_printed_unit(result.reference.get(name, math.nan), UNITS[name]),
            to_printed_unit(result.calibrated.get(name, math.nan), UNITS[name]),
            errors[name],
            floor[name],
            scores[name],
        )
        for name, value in result.observed.items()
    ]


def facts(case: CaseRecord) -> list[str]:
    """Return kind, conduction, beat, volume, pressure and mesh of a case."""
    conduction = {"healthy": "healthy conduction", "lbbb": "left bundle branch block"}[case.conduction]
    volume = case.measured["lv_volume"].values
    largest, least = float(volume.max()) / ML, float(volume.min()) / ML
    return [
        CASE_KINDS[case.kind],
        conduction,
        f"beat of {1e3 * case.registered.period:.0f} ms in {len(case.registered.times)} phases",
        f"left ventricle {largest:.0f} to {least:.0f} mL, ejection fraction {100 * (1 - least / largest):.0f} %",
        "pressure recorded" if "lv_pressure" in case.measured else "no pressure recorded",
        f"{len(case.mesh.tets)} tetrahedra",
    ]


def status(fit: FittedCase) -> str:
    """Return the outcome of a calibration in a few words."""
    if not fit.completed:
        return "calibrated beat failed"
    failed = fit.result.failed_points
    remarks = [f"{failed} of {fit.result.sigma_points} points failed"] if failed else []
    remarks += [f"long step {LONG_STEP_MARK}"] if fit.result.long_steps() else []
    return ", ".join(["calibrated", *remarks])


COLUMNS, PANEL_HEIGHT = 5, 2.1


def plot_cohort(cases: Sequence[CaseRecord], colours: Mapping[str, str]) -> Picture:
    """Plot the left ventricular volume of each case: measured, at the prior mean, and calibrated by setting.

    colours: of the settings.
    """
    with rc_context(TEXT):
        figure, panels = grid(len(cases), COLUMNS, PANEL_HEIGHT)
        for axes, case in zip(panels, cases, strict=True):
            _volume(axes, case, colours)
        panels[0].set_ylabel("LV volume (mL)")
        legend(figure, panels)
        return as_picture(
            figure, "Left ventricular volume over a beat of " + ", ".join(case.name for case in cases)
        )


def _volume(axes: Axes, case: CaseRecord, colours: Mapping[str, str]) -> None:
    times, values = samples(case.measured, "lv_volume", 1e6)
    axes.plot(times, values, "o", color=MEASURED, markersize=2.4, label="measured")
    for label, curves, _, shade, style in simulated(case, colours):
        axes.plot(
            *samples(curves, "lv_volume", 1e6), linestyle=style, color=shade, linewidth=1.3, label=label
        )
    axes.set_title(case.name)
    axes.set_xlabel("time (s)")
    axes.set_xlim(0.0, case.registered.period)
    clean(axes)

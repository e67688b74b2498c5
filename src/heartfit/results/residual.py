"""Residuals of a case by sample, as a table, as sentences and as a figure."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure, SubFigure

from heartfit.observation.beat import BeatPhases
from heartfit.observation.residual import CaseResidual, Misfit, Residual, StrainResidual
from heartfit.observation.strain import DIRECTIONS, SEGMENTS
from heartfit.results.drawing import draw_bullseye
from heartfit.results.figures import clean
from heartfit.results.text import printed_curve_unit

CURVE_LABELS = {
    "lv_volume": "LV volume",
    "rv_volume": "RV volume",
    "lv_pressure": "LV pressure",
    "aorta_pressure": "aortic pressure",
}
SEGMENT_WALLS = ("anterior", "anteroseptal", "inferoseptal", "inferior", "inferolateral", "anterolateral")
APICAL_WALLS = ("anterior", "septal", "inferior", "lateral")
SEGMENT_NAMES = [
    *(f"{level} {wall}" for level in ("basal", "mid") for wall in SEGMENT_WALLS),
    *(f"apical {wall}" for wall in APICAL_WALLS),
]
"""Names of the segments 1 to 16 (Cerqueira et al. 2002, doi 10.1161/hc0402.102975)."""
COLUMNS = ["curve", "beat", "time (s)", "phase", "unit", "difference", "noise", "score"]


def residual_table(residual: CaseResidual) -> pd.DataFrame:
    """Return one row per sample and beat, then one per segment and direction of the strain at end systole.

    Volumes in mL, pressures in kPa, strain in percent; score: difference over noise, empty without a measured noise.
    No rows if no beat was completed.
    """
    if residual.phases is None:
        return pd.DataFrame(columns=COLUMNS)
    rows = [
        _curve_rows(curve, residual.phases, beat) for curve in residual.curves for beat in curve.simulated
    ]
    if residual.strain is not None:
        rows.append(_strain_rows(residual.strain, residual.phases, residual.label))
    return pd.concat(rows)[COLUMNS]


def _curve_rows(residual: Residual, phases: BeatPhases, beat: str) -> pd.DataFrame:
    unit, size = printed_curve_unit(residual.curve)
    return pd.DataFrame(
        {
            "curve": residual.curve,
            "beat": beat,
            "time (s)": residual.times,
            "phase": phases.names_at(residual.times),
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
            "phase": phases.names_at(np.array([strain.time]))[0],
            "unit": "%",
            "difference": 100.0 * strain.difference.ravel(),
            "noise": np.nan if strain.noise is None else 100.0 * strain.noise.ravel(),
            "score": np.nan if strain.noise is None else strain.score().ravel(),
        }
    )


def misfit_sentence(worst: Misfit) -> str:
    """Return "LV volume in early filling: simulation 8.2 mL too large (3.1 times the noise)"."""
    unit, size = printed_curve_unit(worst.curve)
    sign = "large" if worst.difference > 0 else "small"
    return (
        f"{CURVE_LABELS[worst.curve]} in {worst.phase}: "
        f"simulation {abs(worst.difference) / size:.1f} {unit} too {sign} "
        f"({abs(worst.score):.1f} times the noise)"
    )


def segment_misfit_sentence(strain: StrainResidual) -> str:
    """Return "segment 16, apical lateral, shortens too much by 10 % of its length (...)"."""
    scores = strain.score()[DIRECTIONS.index("circumferential")]
    worst = int(np.abs(scores).argmax())
    difference = 100.0 * strain.difference[DIRECTIONS.index("circumferential"), worst]
    amount = "much" if difference < 0.0 else "little"
    noise = "" if strain.noise is None else f" ({abs(scores[worst]):.1f} times the noise)"
    size = f"{abs(difference):.0f} % of its length{noise}"
    return f"segment {SEGMENTS[worst]}, {SEGMENT_NAMES[worst]}, shortens too {amount} by {size}"


LABELS = ONE_STEP, CONVERGED = "after one step", "converged"
STYLE: dict[str, dict[str, Any]] = {
    ONE_STEP: {"linestyle": "--", "linewidth": 1.2},
    CONVERGED: {"linestyle": "-", "linewidth": 1.8, "marker": "o", "markersize": 3},
}
PHASE_LABELS = {
    "isovolumic contraction": "IVC",
    "isovolumic relaxation": "IVR",
    "early filling": "early\nfilling",
    "diastasis": "dia-\nstasis",
    "atrial systole": "atrial\nsystole",
}
"""Abbreviations of the phases of the beat."""
NOISE_BAND = 2.0
"""Half width of the band that contains 95 % of the noise [standard deviations]."""
CAUTION = (
    "Dashed: residuals after one step of the unscented transform, as large in a complete model; "
    "only residuals of the converged fit can be physics."
)
STRAIN_LIMIT = 4.0
"""Least range of the colours [score]."""
COLOUR_REACH = 1.5
"""Range of the colours over the largest score; above one, black numbers stay legible."""


def plot_residual(residual: CaseResidual, title: str, colour: str) -> Figure:
    """Plot one strip per curve over the beat in units of noise, and the strain at end systole by segment.

    The title has the largest mean misfit of the last beat and its worst segment, or says that no beat was completed.
    colour: of the setting.
    """
    curves, phases = residual.curves, residual.phases
    figure = Figure(figsize=(11, 1.4 + 1.55 * max(len(curves), 1)), layout="constrained")
    if phases is None:
        figure.suptitle(f"{title}: no beat was completed", fontsize=11)
        return figure
    left, right = figure.subfigures(1, 2, squeeze=False, width_ratios=(2.1, 1))[0]
    strips = left.subplots(len(curves), 1, sharex=True, squeeze=False)[:, 0]
    for axes, curve in zip(strips, curves, strict=True):
        _strip(axes, curve, phases, colour)
    _name_phases(strips[0], phases)
    strips[0].legend(frameon=False, fontsize=8, loc="best", ncols=2)
    strips[-1].set_xlabel("time after trigger (s)")
    left.supylabel("simulated − measured, in units of noise", fontsize=9)
    if residual.strain is not None:
        _segments(right, residual.strain)
    figure.suptitle("\n".join([f"{title}, {residual.label}", *_heading(residual)]), fontsize=11)
    figure.supxlabel(CAUTION, fontsize=8)
    return figure


def _heading(residual: CaseResidual) -> list[str]:
    """Return one sentence on the worst curve, and one on the worst segment."""
    segment = (
        [] if residual.strain is None else [f"At end systole {segment_misfit_sentence(residual.strain)}"]
    )
    return [misfit_sentence(residual.misfits()[0]), *segment]


def _strip(axes: Axes, residual: Residual, phases: BeatPhases, colour: str) -> None:
    axes.axhspan(-NOISE_BAND, NOISE_BAND, color="#dddddd", linewidth=0)
    axes.axhline(0.0, color="black", linewidth=0.6)
    for label in residual.simulated:
        style = {"color": colour} | _style(label, len(residual.times))
        axes.plot(residual.times, residual.score(label), label=label, **style)
    for _, start, _ in phases.spans():
        axes.axvline(start, color="black", linewidth=0.4, linestyle=":")
    reach = max(np.abs(residual.score(label)).max() for label in residual.simulated)
    axes.set_ylim(*(1.1 * max(reach, 1.5 * NOISE_BAND) * np.array([-1, 1])))
    axes.set_ylabel(CURVE_LABELS[residual.curve], fontsize=9)
    axes.set_xlim(0.0, phases.period)
    clean(axes)


def _style(label: str, samples: int) -> dict[str, Any]:
    """Return the style of a beat, with markers only for few samples."""
    style = STYLE[label]
    return style if samples < 50 else {key: value for key, value in style.items() if key != "marker"}


def _name_phases(axes: Axes, phases: BeatPhases) -> None:
    for name, start, end in phases.spans():
        if end - start > 0.02 * phases.period:
            axes.text(
                0.5 * (start + end), 1.02, PHASE_LABELS.get(name, name), transform=axes.get_xaxis_transform(),
                ha="center", va="bottom", fontsize=7.5,
            )  # fmt: skip


def _segments(figure: SubFigure, strain: StrainResidual) -> None:
    """Draw the circumferential strain of each segment."""
    axes = figure.subplots()
    score = strain.score()[DIRECTIONS.index("circumferential")]
    limit = COLOUR_REACH * max(STRAIN_LIMIT, float(np.abs(score).max()))
    scale = ScalarMappable(Normalize(-limit, limit), colormaps["PuOr_r"])
    shown = zip((np.round(score) + 0.0).tolist(), scale.to_rgba(score), strict=True)
    draw_bullseye(axes, dict(zip(SEGMENTS.tolist(), shown, strict=True)))
    unit = "percent of length" if strain.noise is None else "units of noise"
    axes.set_title(f"circumferential strain at end systole,\nsimulated − measured, {unit}", fontsize=9)
    figure.colorbar(scale, ax=axes, shrink=0.6, location="bottom", label="shortens too much  |  too little")

"""What the simulation gets wrong, for a reader of ten seconds: which curve, when, which sign, which segment."""

from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure, SubFigure

from heartfit.observation.beat_phases import BeatPhases
from heartfit.observation.residual import CaseResidual, Residual
from heartfit.observation.strain import DIRECTIONS, SEGMENTS
from heartfit.observation.strain_residual import StrainResidual
from heartfit.tables.bullseye import draw_bullseye
from heartfit.tables.figures import CALIBRATED, REFERENCE, clean
from heartfit.tables.residual_table import NAMES, segment_sentence, sentence

LABELS = ONE_STEP, CONVERGED = "after one step", "converged"
STYLE: dict[str, dict[str, Any]] = {
    ONE_STEP: {"color": REFERENCE, "linestyle": "--", "linewidth": 1.3},
    CONVERGED: {"color": CALIBRATED, "linestyle": "-", "linewidth": 1.8, "marker": "o", "markersize": 3},
}
SHORT = {"isovolumic contraction": "IVC", "isovolumic relaxation": "IVR", "early filling": "early\nfilling"}
SHORT |= {"atrial systole": "atrial\nsystole"}
NOISE = 2.0
"""Half width of the band that noise alone fills in 95 % of the samples, in units of it."""
CAUTION = (
    "Grey: one step of the unscented transform leaves residuals of this size in models that lack nothing; "
    "only what the converged fit leaves may be physics."
)
STRAIN_LIMIT = 4.0
"""Score that the colours reach at least."""
PALER = 1.5
"""How far the colours go beyond the largest score, so that black numbers stay legible."""


def plot_residual(residual: CaseResidual, title: str) -> Figure:
    """One strip per curve over the phases of the beat, in units of noise, and the strain at end systole by segment.

    The heading names the largest mean misfit of the last beat and its worst segment, or that no beat was completed.
    """
    found, phases = residual.curves, residual.phases
    figure = Figure(figsize=(11, 1.4 + 1.55 * max(len(found), 1)), layout="constrained")
    if phases is None:
        figure.suptitle(f"{title}: no beat was completed", fontsize=11)
        return figure
    left, right = figure.subfigures(1, 2, squeeze=False, width_ratios=(2.1, 1))[0]
    strips = left.subplots(len(found), 1, sharex=True, squeeze=False)[:, 0]
    for axes, each in zip(strips, found, strict=True):
        _strip(axes, each, phases)
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
    """Of the curves and of the segments the worst, a sentence each."""
    segment = [] if residual.strain is None else [f"At end systole {segment_sentence(residual.strain)}"]
    return [sentence(residual.misfits()[0]), *segment]


def _strip(axes: Axes, residual: Residual, phases: BeatPhases) -> None:
    axes.axhspan(-NOISE, NOISE, color="#dddddd", linewidth=0)
    axes.axhline(0.0, color="black", linewidth=0.6)
    for label in residual.simulated:
        axes.plot(residual.times, residual.score(label), label=label, **_style(label, len(residual.times)))
    for _, start, _ in phases.spans():
        axes.axvline(start, color="black", linewidth=0.4, linestyle=":")
    reach = max(np.abs(residual.score(label)).max() for label in residual.simulated)
    axes.set_ylim(*(1.1 * max(reach, 1.5 * NOISE) * np.array([-1, 1])))
    axes.set_ylabel(NAMES[residual.curve], fontsize=9)
    axes.set_xlim(0.0, phases.period)
    clean(axes)


def _style(label: str, samples: int) -> dict[str, Any]:
    """Markers only where samples are few."""
    style = STYLE[label]
    return style if samples < 50 else {key: value for key, value in style.items() if key != "marker"}


def _name_phases(axes: Axes, phases: BeatPhases) -> None:
    for name, start, end in phases.spans():
        if end - start > 0.02 * phases.period:
            axes.text(
                0.5 * (start + end), 1.02, SHORT.get(name, name), transform=axes.get_xaxis_transform(),
                ha="center", va="bottom", fontsize=7.5,
            )  # fmt: skip


def _segments(figure: SubFigure, strain: StrainResidual) -> None:
    """The circumferential strain of each segment."""
    axes = figure.subplots()
    score = strain.score()[DIRECTIONS.index("circumferential")]
    limit = PALER * max(STRAIN_LIMIT, float(np.abs(score).max()))
    scale = ScalarMappable(Normalize(-limit, limit), colormaps["PuOr_r"])
    shown = zip((np.round(score) + 0.0).tolist(), scale.to_rgba(score), strict=True)
    draw_bullseye(axes, dict(zip(SEGMENTS.tolist(), shown, strict=True)))
    unit = "percent of length" if strain.noise is None else "units of noise"
    axes.set_title(f"circumferential strain at end systole,\nsimulated − measured, {unit}", fontsize=9)
    figure.colorbar(scale, ax=axes, shrink=0.6, location="bottom", label="shortens too much  |  too little")

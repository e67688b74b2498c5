"""The cohort at a glance: a small picture of each case."""

from collections.abc import Sequence

from matplotlib import rc_context
from matplotlib.axes import Axes

from heartfit.report.curves_figure import samples, simulated
from heartfit.report.grid import grid, legend
from heartfit.report.picture import TEXT, Picture, picture
from heartfit.report.record import CaseRecord
from heartfit.tables.figures import MEASURED, clean

COLUMNS, HEIGHT = 5, 2.1


def plot_cohort(cases: Sequence[CaseRecord]) -> Picture:
    """The left ventricular volume of each case, measured, at the prior's mean and calibrated under each setting."""
    with rc_context(TEXT):
        figure, panels = grid(len(cases), COLUMNS, HEIGHT)
        for axes, case in zip(panels, cases, strict=True):
            _volume(axes, case)
        panels[0].set_ylabel("LV volume (mL)")
        legend(figure, panels)
        return picture(
            figure, "Left ventricular volume over a beat of " + ", ".join(case.name for case in cases)
        )


def _volume(axes: Axes, case: CaseRecord) -> None:
    times, values = samples(case.measured, "lv_volume", 1e6)
    axes.plot(times, values, "o", color=MEASURED, markersize=2.4, label="measured")
    for label, curves, _, shade, style in simulated(case):
        axes.plot(
            *samples(curves, "lv_volume", 1e6), linestyle=style, color=shade, linewidth=1.3, label=label
        )
    axes.set_title(case.name)
    axes.set_xlabel("time (s)")
    axes.set_xlim(0.0, case.registered.period)
    clean(axes)

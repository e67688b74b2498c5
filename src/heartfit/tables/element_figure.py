"""What linear tetrahedra leave of a locking-free heart, beside what the right element leaves."""

from collections.abc import Mapping, Sequence

from matplotlib.figure import Figure

from heartfit.diagnosis.rivals import Rival
from heartfit.geometry.arrays import Floats
from heartfit.observation.curve import Curve
from heartfit.tables.figures import ARTERY, ATRIUM, CALIBRATED, clean

COLOURS = (CALIBRATED, ARTERY, ATRIUM)
PANELS = {
    "lv_volume": ("LV volume (mL)", 1e6),
    "lv_pressure": ("LV pressure (kPa)", 1e-3),
}


def plot_element(
    measured: Mapping[str, Curve], errors: Mapping[str, Floats], rivals: Sequence[Rival]
) -> Figure:
    """Simulated less measured of every rival over the beat; the band holds the noise in 95 % of the samples."""
    figure = Figure(figsize=(7.5, 4.6), layout="constrained")
    for axes, (name, (label, factor)) in zip(
        figure.subplots(len(PANELS), 1, sharex=True), PANELS.items(), strict=True
    ):
        curve, noise = measured[name], factor * errors[name]
        axes.fill_between(curve.times, -2.0 * noise, 2.0 * noise, color="0.9", label="noise")
        for rival, colour in zip(rivals, COLOURS, strict=False):
            left = factor * (rival.curves[name](curve.times) - curve.values)
            axes.plot(curve.times, left, color=colour, linewidth=1.6, label=rival.name)
        axes.axhline(0.0, color="black", linewidth=0.6)
        axes.set_ylabel(label, fontsize=9)
        clean(axes)
    figure.axes[0].legend(frameon=False, fontsize=8, ncols=4, loc="upper right")
    figure.axes[-1].set_xlabel("time after trigger (s)")
    figure.supylabel("simulated − measured", fontsize=9)
    return figure

"""The element of the mesh as a competing explanation of a misfit: evidence, errors and curves of each model."""

from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from heartfit.core.arrays import Floats
from heartfit.observation.curve import Curve
from heartfit.results.figures import ARTERY, ATRIUM, CALIBRATED, clean
from heartfit.results.text import printed_ratio
from heartfit.synthetic.element import CompetingModel


def element_table(models: Sequence[CompetingModel], hidden: Mapping[str, float]) -> pd.DataFrame:
    """Return one row per model, the baseline first; errors of the parameters against the ``hidden`` values, SI [%]."""
    return pd.DataFrame([_model_row(model, models[0], hidden) for model in models])


def _model_row(
    model: CompetingModel, baseline: CompetingModel, hidden: Mapping[str, float]
) -> dict[str, Any]:
    ratios = {f"{gain.curve}, error ratio": printed_ratio(gain.ratio, gain.interval) for gain in model.gains}
    errors = {f"{name} (%)": 100.0 * (model.parameters[name] / value - 1.0) for name, value in hidden.items()}
    return {
        "explanation": model.name,
        "ln Bayes factor": model.log_evidence - baseline.log_evidence,
        f"misfit of {model.samples}": model.misfit,
        **ratios,
        **errors,
        "beats": model.simulations,
    }


COLOURS = (CALIBRATED, ARTERY, ATRIUM)
PANELS = {
    "lv_volume": ("LV volume (mL)", 1e6),
    "lv_pressure": ("LV pressure (kPa)", 1e-3),
}


def plot_element(
    measured: Mapping[str, Curve], errors: Mapping[str, Floats], models: Sequence[CompetingModel]
) -> Figure:
    """Plot simulated less measured of each model over the beat; the band contains 95 % of the noise."""
    figure = Figure(figsize=(7.5, 4.6), layout="constrained")
    for axes, (name, (label, factor)) in zip(
        figure.subplots(len(PANELS), 1, sharex=True), PANELS.items(), strict=True
    ):
        curve, noise = measured[name], factor * errors[name]
        axes.fill_between(curve.times, -2.0 * noise, 2.0 * noise, color="0.9", label="noise")
        for model, colour in zip(models, COLOURS, strict=False):
            misfit = factor * (model.curves[name](curve.times) - curve.values)
            axes.plot(curve.times, misfit, color=colour, linewidth=1.6, label=model.name)
        axes.axhline(0.0, color="black", linewidth=0.6)
        axes.set_ylabel(label, fontsize=9)
        clean(axes)
    figure.axes[0].legend(frameon=False, fontsize=8, ncols=4, loc="upper right")
    figure.axes[-1].set_xlabel("time after trigger (s)")
    figure.supylabel("simulated − measured", fontsize=9)
    return figure

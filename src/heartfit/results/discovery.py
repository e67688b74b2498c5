"""Diagnoses beside planted effects, and the element as a competing explanation."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from heartfit.core.arrays import Floats
from heartfit.observation.curve import Curve
from heartfit.results.cause_card import UNITS
from heartfit.results.errors import root_mean_square
from heartfit.results.figures import ARTERY, ATRIUM, CALIBRATED, clean
from heartfit.results.text import printed_ratio
from heartfit.synthetic.element import CompetingModel

GAINS = {
    "lv_volume": "LV volume ratio",
    "lv_pressure": "LV pressure ratio",
    "rv_volume": "RV volume ratio",
    "circumferential strain": "strain ratio",
}


@dataclass(frozen=True)
class DiscoveryResult:
    """Diagnosis of one case, and the truth that only an evaluation may know.

    cause: content of cause.json; before, after: parameters without and with the extension [SI]; planted: name,
    amplitude [SI] and unit of each hidden effect of a virtual case; truth: parameters of the virtual case [SI].
    """

    case: str
    setting: str
    cause: Mapping[str, Any]
    before: Mapping[str, float]
    after: Mapping[str, float]
    planted: Sequence[tuple[str, float, str]]
    truth: Mapping[str, float]

    def bias(self, estimate: Mapping[str, float]) -> float:
        """Return the root mean square of ln(estimate / truth) [%] over the parameters with a truth except K."""
        names = [name for name in self.before if name in self.truth and name != "K"]
        errors = [np.log(estimate[name] / self.truth[name]) for name in names]
        return 100.0 * float(root_mean_square(errors)) if errors else float("nan")


def discovery_table(cases: Sequence[DiscoveryResult]) -> pd.DataFrame:
    """Return one row per case: planted effect, verdict, sizes, held-out error ratios and bias of the parameters [%].

    A ratio below one means that the extension reduces the held-out error. K has no true value.
    """
    return pd.DataFrame([_discovery_row(case) for case in cases])


def _discovery_row(case: DiscoveryResult) -> dict[str, Any]:
    named = case.cause["mechanisms"]
    ratios = {gain["curve"]: gain["ratio"] for gain in case.cause["gain"]}
    return {
        "case": case.case,
        "setting": case.setting,
        "planted": ", ".join(
            f"{name} {_printed_amplitude(value, unit)}" for name, value, unit in case.planted
        ),
        "verdict": case.cause["verdict"],
        "named": ", ".join(_named_mechanism(cause) for cause in named),
        "ln BF": named[0]["ln_bayes_factor"] if named else max(case.cause["ranking"].values()),
        "best of the ranking": max(case.cause["ranking"], key=case.cause["ranking"].__getitem__),
        **{column: ratios.get(curve, float("nan")) for curve, column in GAINS.items()},
        "bias before (%)": case.bias(case.before),
        "bias after (%)": case.bias(case.after),
        "beats": case.cause["simulations"],
    }


def _named_mechanism(cause: Mapping[str, Any]) -> str:
    value, low, high = (
        _printed_amplitude(size, cause["unit"]) for size in (cause["amplitude"], *cause["interval"])
    )
    return f"{cause['name']} {value} ({low} to {high})"


def _printed_amplitude(value: float, unit: str) -> str:
    printed, factor = UNITS.get(unit, (unit, 1.0))
    return f"{factor * value:.2g} {printed}".strip()


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

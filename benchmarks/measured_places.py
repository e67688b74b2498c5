"""Places at which the residual of the measured heart acts, before and after its filling was extended, and its strokes.

python -m benchmarks.measured_places RESULTS   RESULTS: results/measured_heart of config/measured_heart.yaml, of which
the blood volume and the beat of the central sigma point are read; a minute
"""

import sys
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from benchmarks.measured_table import store_table
from benchmarks.ventricles import ROOT
from heartfit.core.errors import InputError
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.sphere_model.cause import PlaceFunction
from heartfit.discovery.sphere_model.forward_model import candidates, hypothesis
from heartfit.discovery.sphere_model.nominal_heart import NominalHeart
from heartfit.discovery.sphere_model.place_search import PlaceSearch
from heartfit.discovery.sphere_model.problem import SphereProblem
from heartfit.discovery.sphere_model.recentred import fit_nominal_heart
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.searched_recording import VOLUME_ONLY_THRESHOLD
from heartfit.discovery.sphere_model.shown_place import ShownPlace
from heartfit.discovery.sphere_model.strokes import Strokes
from heartfit.io.beats import read_beat
from heartfit.io.configuration import read_cases, read_study
from heartfit.io.figures import write_figure
from heartfit.io.refits import read_measured_case
from heartfit.mechanisms.left_atrium import LeftAtrium
from heartfit.observation.beat import beat_curves
from heartfit.places import REGIONS, Region
from heartfit.places.library import AtrialPressure
from heartfit.results.acting_places import REGIONS as NAMES
from heartfit.results.figures import MEASURED, clean, colour
from heartfit.roles import Mechanism

CASE, SETTING = "patient1", "physical"
HEARTS: dict[str, tuple[tuple[Mechanism, ...], tuple[str, ...]]] = {
    "as it is": ((), ()),
    "with an atrium and inertia": ((LeftAtrium(),), ("MitralDynamics",)),
    "with the two mechanisms": ((), ("MitralDynamics", "RelaxedFriction")),
}
"""Mechanisms of their declared size, and those whose sizes are fitted first."""
KILOPASCAL = 1e3


@dataclass(frozen=True, eq=False)
class ResidualPlaces:
    """Places beside one heart: ln Bayes factors of the best place of each region, and the function in its filling.

    misfit: r'R⁻¹r of the heart alone at its most probable noise.
    """

    misfit: float
    factors: Mapping[Region, float]
    filling: PlaceFunction


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        sys.stderr.write(f"{__doc__}\n")
        return 2
    case = Path(arguments[0]) / CASE
    files = {"measured": case / "curves" / "measured.csv", "second": [case / "curves" / "blood_volume.csv"]}
    recording = read_measured_case(files).recording()
    volume = replace(recording, curves={"lv_volume": recording.curves["lv_volume"]})
    nominal = centred(case / SETTING / "calibration" / "beats" / "0.json")
    hearts = {
        name: places_beside(volume, fitted_heart(volume, nominal, *heart)) for name, heart in HEARTS.items()
    }
    made_by = "benchmarks.measured_places results/measured_heart"
    store_table("measured_heart_places", residual_table(hearts), made_by)
    store_table("measured_heart_strokes", strokes_table(recording), made_by)
    figure = plot_residual_places(hearts, VOLUME_ONLY_THRESHOLD)
    write_figure(ROOT / "docs" / "figures" / "measured_heart_places.png", figure)
    return 0


def strokes_table(recording: Recording) -> pd.DataFrame:
    """Return what both ventricles eject and the error of the difference [mL], as single values of a page."""
    strokes = Strokes.from_recording(recording)
    if strokes is None:
        raise InputError("the recording has no right volume")
    values = {
        "left": strokes.left,
        "right": strokes.right,
        "sd": strokes.sd,
        "difference": strokes.difference,
    }
    return pd.DataFrame(
        [
            {"quantity": name, "value": f"{1e6 * value:.2f}", "unit": "mL", "number": "", "commit": ""}
            for name, value in values.items()
        ]
    )


def centred(beat_file: Path) -> NominalHeart:
    """Return the sphere that is centred on the 3-D beat of the setting, where it follows it."""
    study = read_study([ROOT / "config" / "config.yaml", ROOT / "config" / "measured_heart.yaml"])
    (case,) = (case for case in read_cases(ROOT / study.cases) if case.case == CASE)
    setting = study.setting(SETTING)
    beat = beat_curves(read_beat(beat_file), setting.sensors({}))
    heart = setting.base_heart(case.period)
    try:
        return fit_nominal_heart(heart, beat, ("lv_volume",))
    except InputError:
        return fit_nominal_heart(heart, beat, ())


def fitted_heart(
    volume: Recording, nominal: NominalHeart, added: tuple[Mechanism, ...], named: tuple[str, ...]
) -> NominalHeart:
    """Return the heart with mechanisms, the named ones of the size that fits the volume best."""
    heart = nominal.with_mechanisms(added)
    if not named:
        return heart
    problem = SphereProblem.from_recording(volume, heart)
    library = candidates(problem.model)
    chosen = tuple(library[name] for name in named)
    with_named = hypothesis(problem.model, chosen)
    explained = FitContext(problem.data).explain(with_named, with_named.at(1.0))
    if explained is None:
        raise InputError(f"the heart with {named} does not beat")
    sizes = np.split(
        explained.fit.x[len(problem.model.base) :], np.cumsum([len(one.unknowns) for one in chosen])[:-1]
    )
    return heart.with_mechanisms(one.at(x) for one, x in zip(chosen, sizes, strict=True))


def places_beside(volume: Recording, nominal: NominalHeart) -> ResidualPlaces:
    """Return the evidence of every region beside a heart, and the function of time in its filling."""
    problem = SphereProblem.from_recording(volume, nominal)
    search = PlaceSearch(FitContext(problem.data), problem.model, problem.fit())
    ranked = search.run()
    filling = search.fitted_beside(AtrialPressure, ranked.places[0])
    left = problem.data.values - ranked.baseline.fit.predicted
    levels, _ = search.context.whitening.most_probable_levels(left)
    misfit = float(left @ np.linalg.solve(problem.data.noise_covariance(levels), left))
    factors = {region: place.ln_bayes_factor for region, place in ranked.by_region().items()}
    return ResidualPlaces(misfit, factors, ShownPlace.from_search(search, filling).function())


def residual_table(hearts: Mapping[str, ResidualPlaces]) -> pd.DataFrame:
    """Return a row for each heart, with the ln Bayes factor of every region."""
    return pd.DataFrame(
        [
            {"heart": name, "misfit": f"{one.misfit:.0f}"}
            | {region: f"{one.factors[region]:.1f}" for region in REGIONS if region in one.factors}
            for name, one in hearts.items()
        ]
    )


def plot_residual_places(hearts: Mapping[str, ResidualPlaces], threshold: float) -> Figure:
    """Plot the evidence of every region beside the ``threshold`` of a detection, and the functions in the filling."""
    figure = Figure(figsize=(12, 4.2), layout="constrained")
    bars, curves = figure.subplots(1, 2, width_ratios=(1.0, 1.3))
    _evidence(bars, hearts, threshold)
    for index, (name, one) in enumerate(hearts.items()):
        _function(curves, one.filling, colour(index), name)
    curves.axhline(0.0, color="black", linewidth=0.6)
    curves.set_xlabel("time after trigger (s)")
    curves.set_ylabel("pressure that filling lacks (kPa), 95 % band")
    curves.legend(frameon=False, fontsize=8)
    clean(curves)
    return figure


def _evidence(axes: Axes, hearts: Mapping[str, ResidualPlaces], threshold: float) -> None:
    height, rows = 0.8 / len(hearts), np.arange(len(REGIONS))
    for index, (name, one) in enumerate(hearts.items()):
        values = [max(one.factors.get(region, 0.0), 0.0) for region in REGIONS]
        axes.barh(rows + index * height, values, height, color=colour(index), label=name)
    axes.axvline(threshold, color=MEASURED, linestyle="--", linewidth=0.9)
    axes.set_yticks(rows + 0.4 - 0.5 * height, [NAMES[region] for region in REGIONS], fontsize=8)
    axes.invert_yaxis()
    axes.set_xlabel("ln Bayes factor of a free function (dashed: detected)")
    clean(axes)


def _function(axes: Axes, function: PlaceFunction, shade: str, name: str) -> None:
    mean, reach = function.mean / KILOPASCAL, 2.0 * function.sd / KILOPASCAL
    axes.fill_between(function.times, mean - reach, mean + reach, color=shade, alpha=0.15, linewidth=0)
    axes.plot(function.times, mean, color=shade, linewidth=1.6, label=name)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

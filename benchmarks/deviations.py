"""Effects of departures from the paper; writes the tables deviations_*.tsv of docs/measured, ten minutes.

python -m benchmarks.deviations RESULTS   RESULTS: folder of a finished study, of which virtual hearts are read

Then `python3 study.py numbers` fills studies/calibration/deviations.md.
"""

import subprocess
import sys
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from benchmarks.deviations_spheres import SLOPE, Score, length_dependence, scales, weights
from benchmarks.deviations_step import ADDITIVE, LOGARITHMIC
from benchmarks.deviations_ventricles import (
    FILLED,
    NOT_UNLOADED,
    STARLING,
    VOLUMES,
    Calibration,
    Ventricles,
    calibrations,
    other_conductions,
    single_beats,
)
from benchmarks.ventricles import ROOT
from heartfit.io.configuration import read_cases, read_study
from heartfit.io.files import write_text
from heartfit.observation.operator import PressureFeatures
from heartfit.study.study import Study

SETTINGS = ("locking", "physical")
VICINITY, FAR, PATIENT = "volunteer1", "volunteer6", "lbbb1"
"""A volunteer near the mean of the prior, the one farthest from it, and a patient with a fitted map of activation."""
NUMBERS = (*VOLUMES, *PressureFeatures.names, FILLED)
Rows = list[list[str]]


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        sys.stderr.write(f"{__doc__}\n")
        return 2
    study = read_study([ROOT / "config" / "config.yaml"])
    cases = {case.case: case for case in read_cases(ROOT / study.cases)}
    near, far, patient = (
        Ventricles.of(study, cases[name], Path(arguments[0])) for name in (VICINITY, FAR, PATIENT)
    )
    tables: dict[str, Callable[[], Rows]] = {
        "scale": lambda: scale_rows(study),
        "weights": lambda: weight_rows(study),
        "length": lambda: length_rows(study),
        "activation": lambda: activation_rows(patient),
        "beats": lambda: beat_rows(near),
        "calibrations": lambda: calibration_rows(near, far),
    }
    for name, rows in tables.items():
        _write(name, rows())
    return 0


def _write(name: str, rows: Rows) -> None:
    commit = subprocess.run(
        ["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.strip()
    made_by = f"# made by: python -m benchmarks.deviations RESULTS; commit: {commit}"
    text = "\n".join([made_by, *("\t".join(row) for row in rows)])
    write_text(ROOT / "docs" / "measured" / f"deviations_{name}.tsv", f"{text}\n")


def _score_cells(score: Score) -> list[str]:
    median, largest = score.observations
    return [f"{median:.1f}, {largest:.0f}", f"{score.parameters:.0f}"]


def scale_rows(study: Study) -> Rows:
    """Rows of the two scales on spheres."""
    head = [
        "observed",
        "spread of hearts and prior",
        "scale",
        "error: median, largest (%)",
        "error of ln theta (%)",
    ]
    rows = [[*head, "sigma points below zero", "hearts without an estimate"]]
    for observed, width, scale, score in scales(study):
        spread = "as in the study" if width == 1.0 else f"{width:g} times"
        lost = f"{score.lost} of {study.sphere_study.hearts}"
        rows.append([observed, spread, scale, *_score_cells(score), str(score.impossible), lost])
    return rows


def weight_rows(study: Study) -> Rows:
    """Rows of the distance of the sigma points on spheres."""
    rows = [["a", "error: median, largest (%)", "error of ln theta (%)"]]
    return rows + [[f"{a:g}", *_score_cells(score)] for a, score in weights(study)]


def length_rows(study: Study) -> Rows:
    """Rows of spheres whose n_0 depends on length, calibrated without and with that dependence."""
    head = ["observed", "slope of the calibrator", "error: median, largest (%)", "error of ln theta (%)"]
    rows = [[*head, "mean error of ln sigma_0, ln mu (%)"]]
    for observed, slope, score in length_dependence(study):
        bias = f"{score.bias['sigma_0']:+.1f}, {score.bias['mu']:+.1f}"
        known = "0, as in the study" if slope == 0.0 else f"{SLOPE:g}, the true one"
        rows.append([observed, known, *_score_cells(score), bias])
    return rows


def calibration_rows(near: Ventricles, far: Ventricles) -> Rows:
    """Rows of calibrations in 3-D."""
    head = ["volunteer, setting", "variant", *(f"{name} (%)" for name in VOLUMES), "EDV (%)"]
    rows = [[*head, "longest move (prior sd)", "estimate over truth"]]
    steps = (LOGARITHMIC, ADDITIVE)
    runs = (
        (near, "physical", (*steps, NOT_UNLOADED, STARLING)),
        (near, "locking", (*steps, NOT_UNLOADED)),
        (far, "locking", steps),
    )
    for ventricles, setting, variants in runs:
        fits = calibrations(ventricles, setting, variants)
        rows += [_calibration_row(ventricles, calibration) for calibration in fits]
    return rows


def _calibration_row(ventricles: Ventricles, calibration: Calibration) -> list[str]:
    name = f"{ventricles.case.case}, `{calibration.setting}`"
    ratios = [
        f"{parameter} {_printed(parameter, value, ventricles.truth)}"
        for parameter, value in calibration.estimate.items()
    ]
    errors = [f"{value:+.1f}" for value in calibration.errors.values()]
    return [name, calibration.variant, *errors, f"{calibration.longest:.1f}", ", ".join(ratios)]


def _printed(parameter: str, value: float, truth: Mapping[str, float]) -> str:
    """Ratio of an estimate to the truth; of K, which has none on a locking mesh, the value."""
    return f"= {value / 1e3:.0f} kPa" if parameter == "K" else f"{value / truth[parameter]:.2f}"


def beat_rows(near: Ventricles) -> Rows:
    """Rows of single beats of a volunteer at the mean of the prior."""
    rows = [["setting", "departure", *(f"{name} (%)" for name in NUMBERS)]]
    for setting in SETTINGS:
        rows += [[f"`{setting}`", *cells] for cells in _change_rows(single_beats(near, setting))]
    return rows


def activation_rows(patient: Ventricles) -> Rows:
    """Rows of single beats of a patient's true heart with other maps of activation."""
    rows = [["instead of the fitted map", *(f"{name} (%)" for name in NUMBERS)]]
    return rows + _change_rows(other_conductions(patient, "physical"))


def _change_rows(changes: Iterable[tuple[str, Mapping[str, float]]]) -> Rows:
    return [[departure, *(f"{change[name]:+.1f}" for name in NUMBERS)] for departure, change in changes]


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

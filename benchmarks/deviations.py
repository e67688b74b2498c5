"""Effects of departures from the paper on a beat; stores docs/measured/deviations_beats and deviations_activation.

python -m benchmarks.deviations RESULTS   RESULTS: folder of a finished study, of which virtual hearts are read

The numbers are those of simulated beats, without images. Then `python3 study.py numbers` fills
studies/calibration/deviations.md. Two minutes.
"""

import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from benchmarks.measured_table import store_table
from benchmarks.ventricles import ROOT
from heartfit.geometry.fibres import prepare
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.activation.conduction import (
    CONDUCTIONS,
    HEALTHY,
    Conduction,
    assign_activation,
    fit_conduction,
)
from heartfit.io.configuration import read_cases, read_study
from heartfit.io.meshes import read_mesh
from heartfit.io.results import read_truth
from heartfit.io.templates import TEMPLATES, find_template
from heartfit.observation.beat import beat_curves
from heartfit.observation.operator import PressureFeatures, VolumeFeatures, cavity_indices, observe
from heartfit.personalise.numerics import TimeScheme
from heartfit.personalise.run import run_beat
from heartfit.personalise.setting import Setting
from heartfit.study.case import Case
from heartfit.study.study import Study
from heartfit.synthetic.volunteer import OTHER_CONDUCTIONS

MODULE = "benchmarks.deviations RESULTS"
VICINITY, PATIENT = "volunteer1", "lbbb1"
"""A volunteer near the mean of the prior, and a patient with a fitted map of activation."""
FILLED = "EDV"
NUMBERS = (*VolumeFeatures.names, *PressureFeatures.names, FILLED)
SLOPES = (0.15, 0.3)
"""Slopes of the length dependence of n_0: of the nominal heart of the search in 3-D, and of the hidden hearts."""
Numbers = dict[str, float]


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        sys.stderr.write(f"{__doc__}\n")
        return 2
    study = read_study([ROOT / "config" / "config.yaml"])
    cases = {case.case: case for case in read_cases(ROOT / study.cases)}
    near, patient = (Ventricles.of(study, cases[name], Path(arguments[0])) for name in (VICINITY, PATIENT))
    store_table("deviations_beats", beats_table(near), MODULE)
    store_table("deviations_activation", activation_table(patient, "physical"), MODULE)
    return 0


@dataclass(frozen=True, eq=False)
class Ventricles:
    """A virtual case as its calibrator sees it: mesh, and true parameters."""

    study: Study
    case: Case
    mesh: VentricularMesh
    truth: Mapping[str, float]

    @classmethod
    def of(cls, study: Study, case: Case, results: Path) -> "Ventricles":
        """Mesh the hidden wall with the calibrator's template, as the study does, without activation."""
        folder, sizes = results / case.case / "cohort", (study.virtual_mesh, study.cohort.mesh)
        template, generator = (find_template(size, ROOT / TEMPLATES) for size in sizes)
        wall = template.fill_wall_of(read_mesh(folder / "heart.vtu"), generator.mesh)
        return cls(study, case, prepare(wall), read_truth(folder / "truth.json"))

    def activated(self, conduction: Conduction | None = None) -> VentricularMesh:
        """The mesh with the case's conduction or another, fitted to the QRS duration if that is known."""
        kind = conduction or CONDUCTIONS[self.case.conduction]
        qrs = None if kind is HEALTHY else self.case.qrs
        return assign_activation(self.mesh, fit_conduction(self.mesh, kind, qrs))

    def numbers(
        self,
        mesh: VentricularMesh,
        setting: Setting,
        parameters: Mapping[str, float],
        scheme: TimeScheme | None = None,
    ) -> Numbers:
        """Six numbers and the largest left volume [SI] of a beat, with the study's numerics unless others are given."""
        pressures = self.study.filling_pressures(self.case)
        beat = run_beat(mesh, setting, self.case.period, parameters, pressures, scheme or self.study.numerics)
        curves = beat_curves(beat)
        features = self.study.observation.trial_features(self.study.observation.frames)
        return {**observe(curves, features), FILLED: cavity_indices(curves)[FILLED]}


def beats_table(near: Ventricles) -> pd.DataFrame:
    """Return the change of each number by a departure, under every setting at the mean of its prior."""
    return pd.DataFrame(
        [
            {"setting": f"`{name}`", "departure": departure, **_changes(usual, other)}
            for name in ("locking", "physical")
            for usual, departure, other in single_beats(near, name)
        ]
    )


def single_beats(ventricles: Ventricles, name: str) -> Iterator[tuple[Numbers, str, Numbers]]:
    """Yield the usual numbers, a departure, and its numbers, in beats of a setting at the mean of its prior."""
    mesh, standard = ventricles.activated(), ventricles.study.setting(name)
    mean = standard.gaussian().physical()
    once = ventricles.study.numerics.model_copy(update={"max_beats": 1})
    departures: dict[str, tuple[Setting, TimeScheme | None]] = {
        "not unloaded": (standard.model_copy(update={"reference": "end_diastolic"}), None),
        **{
            f"n_0 depends on length, slope {slope}": (
                standard.model_copy(update={"heart": {"starling.slope": slope}}),
                None,
            )
            for slope in SLOPES
        },
        "one beat instead of the limit cycle": (standard, once),
    }
    usual = ventricles.numbers(mesh, standard, mean)
    for departure, (setting, scheme) in departures.items():
        yield usual, departure, ventricles.numbers(mesh, setting, mean, scheme)


def activation_table(patient: Ventricles, name: str) -> pd.DataFrame:
    """Return the change of each number of a patient's true heart if the map of activation is another."""
    setting = patient.study.setting(name)
    truth = {parameter: patient.truth[parameter] for parameter in setting.estimate}
    usual, hidden, healthy = (
        patient.numbers(patient.activated(conduction), setting, truth)
        for conduction in (None, OTHER_CONDUCTIONS["lbbb"], HEALTHY)
    )
    rows = {"the hidden map": hidden, "healthy conduction": healthy}
    return pd.DataFrame(
        [{"instead of the fitted map": what, **_changes(usual, other)} for what, other in rows.items()]
    )


def _changes(usual: Numbers, other: Numbers) -> dict[str, str]:
    return {f"{name} (%)": f"{100.0 * (other[name] / usual[name] - 1.0):+.1f}" for name in NUMBERS}


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

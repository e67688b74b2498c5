"""Effect of departures from the paper on ventricles: one volunteer and one patient of a finished study.

The measured numbers are those of the hidden beat, without images, so that errors are those of model and step alone.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks.deviations_step import ADDITIVE, LOGARITHMIC, take_step
from benchmarks.ventricles import ROOT
from heartfit.calibration.unscented import CachedForward, Forward, Outcome
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.fibres import prepare
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.activation.conduction import (
    CONDUCTIONS,
    HEALTHY,
    Conduction,
    assign_activation,
    fit_conduction,
)
from heartfit.heart.beat import Beat
from heartfit.io.beats import read_beat
from heartfit.io.meshes import read_mesh
from heartfit.io.results import read_truth
from heartfit.io.templates import TEMPLATES, find_template
from heartfit.observation.beat import beat_curves
from heartfit.observation.operator import VolumeFeatures, cavity_indices, observe
from heartfit.personalise.numerics import TimeScheme
from heartfit.personalise.run import run_beat
from heartfit.personalise.setting import Setting
from heartfit.study.case import Case
from heartfit.study.study import Study
from heartfit.synthetic.volunteer import OTHER_CONDUCTIONS

SLOPE = "starling.slope"
"""Name of the slope of the length dependence of n_0."""


@dataclass(frozen=True, eq=False)
class Ventricles:
    """A virtual case as its calibrator sees it: mesh, six numbers of the hidden beat [SI], and the truth."""

    study: Study
    case: Case
    mesh: VentricularMesh
    observed: Mapping[str, float]
    truth: Mapping[str, float]

    @classmethod
    def of(cls, study: Study, case: Case, results: Path) -> "Ventricles":
        """Mesh the hidden wall with the calibrator's template, as the study does, without activation."""
        folder, sizes = results / case.case / "cohort", (study.virtual_mesh, study.cohort.mesh)
        template, generator = (find_template(size, ROOT / TEMPLATES) for size in sizes)
        wall = template.fill_wall_of(read_mesh(folder / "heart.vtu"), generator.mesh)
        features = study.observation.trial_features(study.observation.frames)
        observed = observe(beat_curves(read_beat(folder / "beat.json")), features)
        return cls(study, case, prepare(wall), observed, read_truth(folder / "truth.json"))

    def activated(self, conduction: Conduction | None = None) -> VentricularMesh:
        """The mesh with the case's conduction or another, fitted to the QRS duration if that is known."""
        kind = conduction or CONDUCTIONS[self.case.conduction]
        qrs = None if kind is HEALTHY else self.case.qrs
        return assign_activation(self.mesh, fit_conduction(self.mesh, kind, qrs))

    def volume(self) -> float:
        """Volume of the left cavity of the mesh [m^3]."""
        return Cavity.from_endocardium(self.mesh, "lv_endo").volume(self.mesh.points)

    def beat(
        self,
        mesh: VentricularMesh,
        setting: Setting,
        parameters: Mapping[str, float],
        scheme: TimeScheme | None = None,
    ) -> Beat:
        """Beat of these parameters, with the study's numerics unless others are given."""
        pressures = self.study.filling_pressures(self.case)
        return run_beat(mesh, setting, self.case.period, parameters, pressures, scheme or self.study.numerics)

    def numbers(self, beat: Beat) -> dict[str, float]:
        """The six numbers and the largest left volume [SI] of a completed beat."""
        curves = beat_curves(beat)
        features = self.study.observation.trial_features(self.study.observation.frames)
        return {**observe(curves, features), FILLED: cavity_indices(curves)[FILLED]}

    def truth_of(self, setting: Setting) -> dict[str, float]:
        """True values of the parameters that a setting estimates."""
        return {name: self.truth[name] for name in setting.estimate}


VOLUMES = VolumeFeatures.names
FILLED = "EDV"
"""Largest volume of the left ventricle over that of its mesh, which was measured."""
NOT_UNLOADED, STARLING = "not unloaded", "n_0 depends on length"
MILD, HIDDEN = 0.15, 0.3
"""Slopes of the length dependence: of the nominal heart of the search in 3-D, and of the hidden hearts."""


@dataclass(frozen=True, eq=False)
class Calibration:
    """One-step calibration of a volunteer: signed errors of its beat [%], longest move [prior sd], estimate [SI]."""

    setting: str
    variant: str
    errors: Mapping[str, float]
    longest: float
    estimate: Mapping[str, float]


def calibrations(ventricles: Ventricles, name: str, variants: Sequence[str]) -> Iterator[Calibration]:
    """Calibrate a volunteer to its volume under a setting, and under variants of it."""
    mesh, standard = ventricles.activated(), ventricles.study.setting(name)
    settings = {
        NOT_UNLOADED: standard.model_copy(update={"reference": "end_diastolic"}),
        STARLING: standard.model_copy(update={"heart": {SLOPE: HIDDEN}}),
    }
    shared = CachedForward(_forward(ventricles, mesh, standard))
    for variant in variants:
        setting = settings.get(variant, standard)
        forward = CachedForward(_forward(ventricles, mesh, setting)) if variant in settings else shared
        observed = {name: ventricles.observed[name] for name in VOLUMES}
        scale = ADDITIVE if variant == ADDITIVE else LOGARITHMIC
        step = take_step(setting.gaussian(), forward, observed, scale)
        numbers = ventricles.numbers(ventricles.beat(mesh, setting, step.estimate))
        errors = {name: 100.0 * (numbers[name] / value - 1.0) for name, value in observed.items()}
        filled = {FILLED: 100.0 * (numbers[FILLED] / ventricles.volume() - 1.0)}
        yield Calibration(name, variant, errors | filled, step.longest, step.estimate)


def _forward(ventricles: Ventricles, mesh: VentricularMesh, setting: Setting) -> Forward:
    def forward(parameters: Sequence[Mapping[str, float]]) -> list[Outcome]:
        beats = (ventricles.beat(mesh, setting, entry) for entry in parameters)
        return [ventricles.numbers(beat) if beat.completed else beat.reason for beat in beats]

    return forward


def single_beats(ventricles: Ventricles, name: str) -> Iterator[tuple[str, dict[str, float]]]:
    """Yield the change of each number [%] by a departure, in beats of a setting at the mean of its prior."""
    mesh, standard = ventricles.activated(), ventricles.study.setting(name)
    mean = standard.gaussian().physical()
    once = ventricles.study.numerics.model_copy(update={"max_beats": 1})
    beats = {
        NOT_UNLOADED: (standard.model_copy(update={"reference": "end_diastolic"}), None),
        f"{STARLING}, slope {MILD}": (standard.model_copy(update={"heart": {SLOPE: MILD}}), None),
        f"{STARLING}, slope {HIDDEN}": (standard.model_copy(update={"heart": {SLOPE: HIDDEN}}), None),
        "one beat instead of the limit cycle": (standard, once),
    }
    usual = ventricles.numbers(ventricles.beat(mesh, standard, mean))
    for departure, (setting, scheme) in beats.items():
        yield departure, _changes(usual, ventricles.numbers(ventricles.beat(mesh, setting, mean, scheme)))


def other_conductions(ventricles: Ventricles, name: str) -> Iterator[tuple[str, dict[str, float]]]:
    """Yield the change of each number [%] of a patient's true heart if the map of activation is another."""
    setting = ventricles.study.setting(name)
    conductions = {"the hidden map": OTHER_CONDUCTIONS["lbbb"], "healthy conduction": HEALTHY}

    def numbers(conduction: Conduction | None) -> dict[str, float]:
        return ventricles.numbers(
            ventricles.beat(ventricles.activated(conduction), setting, ventricles.truth_of(setting))
        )

    usual = numbers(None)
    for departure, conduction in conductions.items():
        yield departure, _changes(usual, numbers(conduction))


def _changes(usual: Mapping[str, float], other: Mapping[str, float]) -> dict[str, float]:
    return {name: 100.0 * (other[name] / value - 1.0) for name, value in usual.items()}

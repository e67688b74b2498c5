"""Planter of the study's hidden ventricles, and what a search in three dimensions starts from."""

from dataclasses import replace
from functools import cache

from benchmarks.ventricles import ROOT
from heartfit.discovery.refit.model import Reference, activate
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.wall_model.forward_model import WallForwardModel
from heartfit.discovery.wall_model.wall_data import WallRecording
from heartfit.io.configuration import read_study
from heartfit.io.regional_noise import read_regional_noise
from heartfit.io.templates import TEMPLATES, find_template
from heartfit.study.study import Study
from heartfit.synthetic.case import REST, PlantedCase
from heartfit.synthetic.ventricles import ImagedBeat, Imaging, Ventricles


@cache
def study() -> Study:
    """Return the study of the repository."""
    return read_study([ROOT / "config" / "config.yaml"])


@cache
def ventricles() -> Ventricles:
    """Return the planter: hidden hearts are imaged, and the diagnoser's mesh is registered."""
    planned = study().discovery_benchmark.ventricles
    sizes = planned.generator.mesh, planned.diagnoser.mesh
    hidden, observed = (find_template(size, ROOT / TEMPLATES) for size in sizes)
    imaging = Imaging(study().scanner(), study().registration.free_form(), observed, hidden.mesh)
    protocol = planned.generator.protocol(study().end_diastolic_pressure)
    return Ventricles(hidden, study().cohort.heart, protocol, imaging)


@cache
def balanced_ventricles() -> Ventricles:
    """Return the planter of hearts in which both sides pump the same volume, for searches that see both."""
    return replace(ventricles(), balanced=True)


def sphere_reference(imaged: ImagedBeat) -> Reference:
    """Return the study's nominal heart in a registered mesh, on one beat of which a sphere is centred."""
    numerics = study().discovery_benchmark.ventricles.diagnoser.numerics
    return Reference(imaged.mesh, study().nominal_setting(), study().end_diastolic_pressure, numerics)


def wall_recording(imaged: ImagedBeat, case: PlantedCase, pressure: bool = True) -> WallRecording:
    """Return all that was measured of a planted heart: both volumes, the wall's motion, and pressure if wanted."""
    curves = {**imaged.volumes, **({"lv_pressure": case.curves[REST]["lv_pressure"]} if pressure else {})}
    recording = Recording.from_curves(curves)
    return WallRecording(recording, activate(imaged.mesh), imaged.motion, read_regional_noise())


def wall_model(recording: WallRecording) -> WallForwardModel:
    """Return the study's nominal heart in the wall of a recording."""
    heart = study().nominal_setting().base_heart(recording.recording.period)
    return WallForwardModel.at_samples(recording, heart, study().end_diastolic_pressure)

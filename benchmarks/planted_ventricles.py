"""Planter of the study's hidden ventricles, and what a search in three dimensions starts from."""

from functools import cache

import pandas as pd

from benchmarks.ventricles import ROOT
from heartfit.discovery.refit.model import activate
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.wall_model.forward_model import WallForwardModel
from heartfit.discovery.wall_model.unknowns import HeartInWall
from heartfit.discovery.wall_model.wall_data import WallRecording
from heartfit.io.configuration import read_study
from heartfit.observation.gain_noise import GainNoise
from heartfit.observation.regional import BASE_DESCENT, KINDS
from heartfit.observation.regional_noise import RegionalNoise
from heartfit.study.study import Study
from heartfit.synthetic.case import REST, PlantedCase
from heartfit.synthetic.ventricles import ImagedBeat, Imaging, Ventricles
from heartfit.synthetic.volunteer import Template

NOISE = ROOT / "docs" / "measured" / "strain_noise.tsv"


@cache
def study() -> Study:
    """Return the study of the repository."""
    return read_study([ROOT / "config" / "config.yaml"])


@cache
def ventricles() -> Ventricles:
    """Return the planter: hidden hearts are imaged, and the diagnoser's mesh is registered."""
    planned = study().discovery_benchmark.ventricles
    sizes = planned.generator.mesh, planned.diagnoser.mesh
    hidden, observed = (Template.build(size.edge_length, size.tolerance) for size in sizes)
    imaging = Imaging(study().scanner(), study().registration.free_form(), observed, hidden.mesh)
    protocol = planned.generator.protocol(study().end_diastolic_pressure)
    return Ventricles(hidden, study().cohort.heart, protocol, imaging)


@cache
def regional_noise() -> RegionalNoise:
    """Return the noise of regional strain that the registration page prints."""
    table = pd.read_csv(NOISE, sep="\t", comment="#", index_col="curve").fillna(0.0)
    rows = {kind: table.loc["base descent" if kind == BASE_DESCENT else f"{kind} strain"] for kind in KINDS}
    return RegionalNoise(
        {
            kind: GainNoise(
                row["G"], row["sd_g"], row["sd_h"], row["s"], row["tau (s)"], row["r"], row["sequences"]
            )
            for kind, row in rows.items()
        }
    )


def wall_recording(imaged: ImagedBeat, case: PlantedCase, pressure: bool = True) -> WallRecording:
    """Return all that was measured of a planted heart: both volumes, the wall's motion, and pressure if wanted."""
    curves = {**imaged.volumes, **({"lv_pressure": case.curves[REST]["lv_pressure"]} if pressure else {})}
    recording = Recording.from_curves(curves)
    return WallRecording(recording, activate(imaged.mesh), imaged.motion, regional_noise())


def wall_model(recording: WallRecording) -> WallForwardModel:
    """Return the study's nominal heart in the wall of a recording."""
    pressures = study().end_diastolic_pressure
    heart = study().nominal_setting().base_heart(recording.recording.period)
    return WallForwardModel.at_samples(recording, HeartInWall.loaded(heart, pressures.lv, pressures.rv))

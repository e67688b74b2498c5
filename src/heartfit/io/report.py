"""Reads the results of a whole study for its report, and writes the page."""

import hashlib
import platform
from collections.abc import Mapping
from importlib import metadata, resources
from pathlib import Path

import pandas as pd
from PIL import Image
from plotly.offline import get_plotlyjs

from heartfit.calibration.update import Posterior
from heartfit.configuration.case import Case
from heartfit.configuration.setting import Setting
from heartfit.configuration.study import Study
from heartfit.diagnosis.cause import Diagnosis
from heartfit.io.atomic import write_text
from heartfit.io.beats import read_beat
from heartfit.io.causes import read_diagnosis
from heartfit.io.curves import read_curves
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.noise_models import read_noise_model
from heartfit.io.results import read_case, read_fingerprint, read_posterior, read_sigma_points, read_truth
from heartfit.io.simulated_motion import read_simulated_motion
from heartfit.observation.beat import beat_curves
from heartfit.report.band import band
from heartfit.report.page import Assets, render
from heartfit.report.picture import still
from heartfit.report.record import CaseRecord, Curves, Fit, Printed, Provenance, StudyRecord
from heartfit.tables.card import Card
from heartfit.tables.evaluation import comparable
from heartfit.tables.notes import NOTES

TITLES = {
    "table1": "Errors of the healthy hearts (the paper's Table 1)",
    "table2": "Parameters of the healthy hearts (the paper's Table 2)",
    "table3": "Errors of the patients (the paper's Table 3)",
    "table3_parameters": "Parameters of the patients beside the healthy mean (the paper's Table 3)",
    "plausibility": "What no observation holds and must still be plausible",
    "costs": "What it took",
}
PACKAGES = (
    "heartfit",
    "numpy",
    "scipy",
    "numba",
    "SimpleITK",
    "wildmeshing",
    "scikit-fem",
    "snakemake",
    "plotly",
)


def read_study_results(
    folder: Path, study: Study, cases: Mapping[str, Case], left_out: str = ""
) -> StudyRecord:
    """All that the report shows of the study whose results lie in the folder; raises InputError for what is missing."""
    records = {name: _case(Path(folder), study, case) for name, case in cases.items()}
    return StudyRecord(
        records, _tables(Path(folder) / "tables"), _provenance(Path(folder), study, cases), left_out
    )


def write_report(path: Path, study: StudyRecord) -> None:
    """Write the page with everything it shows inside."""
    write_text(path, render(study, assets()))


def assets() -> Assets:
    """The viewer library from its package, our own script and style."""
    own = resources.files("heartfit.report").joinpath("assets")
    texts = [own.joinpath(name).read_text(encoding="utf-8") for name in ("heart.js", "report.css")]
    return Assets(get_plotlyjs(), *texts)


def _case(results: Path, study: Study, case: Case) -> CaseRecord:
    folder = results / case.case
    model = results / "registration_error" / "noise_model.json"
    truth = read_truth(folder / "cohort" / "truth.json") if case.kind == "virtual" else {}
    settings = {name: study.setting(name, case) for name in study.settings}
    return CaseRecord(
        name=case.case,
        kind=case.kind,
        conduction=case.conduction,
        mesh=read_mesh(folder / "geometry" / "mesh.vtu"),
        registered=read_motion(folder / "registration" / "motion.npz"),
        measured=read_curves(folder / "curves" / "measured.csv"),
        noise=[read_noise_model(model)] if case.kind == "virtual" else [],
        fits={name: _fit(folder, name, setting, truth) for name, setting in settings.items()},
        still=_still(results / "figures" / f"{case.case}_activation.png"),
    )


def _still(path: Path) -> str:
    """A figure of the study for print, nothing where it was not drawn."""
    if not path.exists():
        return ""
    with Image.open(path) as picture:
        return still(picture)


def _fit(folder: Path, name: str, setting: Setting, truth: Mapping[str, float]) -> Fit:
    made, checked, searched = (
        folder / name / "calibration",
        folder / name / "verification",
        folder / "discovery" / name,
    )
    met, weighed = (read_posterior(made / f"posterior{noise}.json") for noise in ("", "_noise"))
    calibrated = beat_curves(read_beat(checked / "beat.json"), setting.sensors(met.estimate.physical()))
    beats = _beats(made, setting)
    return Fit(
        result=read_case(checked / "errors.json"),
        card=Card(folder.name, name, met, weighed, comparable(truth)),
        reference=beats[0],
        calibrated=calibrated,
        band=_band(made, beats, weighed, calibrated),
        motion=read_simulated_motion(checked / "motion.npz"),
        searched=_diagnosis(searched / "search"),
        proved=_diagnosis(searched),
    )


def _beats(made: Path, setting: Setting) -> list[Curves]:
    """What is seen of the beat of each sigma point."""
    _, points = read_sigma_points(made / "points.json")
    return [
        beat_curves(read_beat(made / "beats" / f"{point.index}.json"), setting.sensors(point.parameters))
        for point in points
    ]


def _band(made: Path, beats: list[Curves], weighed: Posterior, calibrated: Curves) -> Curves:
    prior, points = read_sigma_points(made / "points.json")
    return band(prior, points, beats, weighed.estimate, calibrated)


def _diagnosis(folder: Path) -> Diagnosis | None:
    return read_diagnosis(folder) if (folder / "cause.json").exists() else None


def _tables(folder: Path) -> dict[str, Printed]:
    return {
        name: Printed(title, pd.read_csv(folder / f"{name}.csv", comment="#"), NOTES.get(name, ""))
        for name, title in TITLES.items()
        if (folder / f"{name}.csv").exists()
    }


def _provenance(results: Path, study: Study, cases: Mapping[str, Case]) -> Provenance:
    verified = {
        f"{case}, {setting}": read_fingerprint(results / case / setting / "verification" / "errors.json")
        for case in cases
        for setting in study.settings
    }
    numbers = hashlib.sha256((results / "tables" / "numbers.csv").read_bytes()).hexdigest()[:16]
    return Provenance(
        fingerprints={"tables/numbers.csv": numbers, **verified},
        seeds={name: str(case.seed) for name, case in cases.items() if case.seed is not None},
        versions={"Python": platform.python_version(), **{name: metadata.version(name) for name in PACKAGES}},
        settings={"study": study.model_dump_json(indent=1)},
    )

"""Results of a whole study for its report, and the assets of the page."""

import hashlib
import platform
from collections.abc import Mapping, Sequence
from importlib import metadata, resources
from pathlib import Path
from typing import Any

import pandas as pd
from PIL import Image
from plotly.offline import get_plotlyjs

from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.io.beats import read_beat
from heartfit.io.causes import read_diagnosis
from heartfit.io.curves import read_curves
from heartfit.io.discoveries import read_discoveries
from heartfit.io.meshes import read_mesh, read_motion, read_simulated_motion
from heartfit.io.results import read_case, read_fingerprint, read_posterior, read_sigma_points, read_truth
from heartfit.io.walls import read_wall
from heartfit.observation.beat import beat_curves
from heartfit.observation.noise_model import NoiseModel
from heartfit.personalise.setting import Setting
from heartfit.results.report.page import Assets
from heartfit.results.report.record import (
    TABLES_OF_TEXT,
    TITLES,
    CaseRecord,
    FittedCase,
    Provenance,
    ReportTable,
    SigmaBeats,
    StudyRecord,
)
from heartfit.study.case import Case
from heartfit.study.study import Study

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
    folder: Path,
    study: Study,
    cases: Mapping[str, Case],
    noise: Sequence[NoiseModel] = (),
    left_out: str = "",
) -> StudyRecord:
    """Read the results of a study for its report; raises InputError for a missing result."""
    sealed = [name for name, case in cases.items() if case.kind == "sealed"]
    records = {name: _case(Path(folder), study, case, noise) for name, case in cases.items()}
    return StudyRecord(
        records,
        tuple(study.settings),
        _tables(Path(folder) / "tables"),
        _provenance(Path(folder), study, cases),
        left_out,
        read_discoveries(Path(folder), study.refitted(cases), sealed),
    )


def assets() -> Assets:
    """Viewer library from its package, with the script and style of the report."""
    own = resources.files("heartfit.results.report").joinpath("assets")
    texts = [own.joinpath(name).read_text(encoding="utf-8") for name in ("heart.js", "report.css")]
    return Assets(get_plotlyjs(), *texts)


def _case(results: Path, study: Study, case: Case, noise: Sequence[NoiseModel]) -> CaseRecord:
    folder = results / case.case
    truth = read_truth(folder / "cohort" / "truth.json") if case.virtual else {}
    settings = {name: study.setting(name, case) for name in study.settings_of(case)}
    return CaseRecord(
        name=case.case,
        kind=case.kind,
        conduction=case.conduction,
        mesh=read_mesh(folder / "geometry" / "mesh.vtu"),
        registered=read_motion(folder / "registration" / "motion.npz"),
        measured=read_curves(folder / "curves" / "measured.csv"),
        noise=noise if case.virtual else (),
        fits={
            name: _fit(folder, name, setting, study.first_step(name), truth)
            for name, setting in settings.items()
        },
        still=_still(results / "figures" / f"{case.case}_activation.png"),
        walls={
            setting: read_wall(folder / "discovery" / setting / "wall")
            for setting in study.discovery.settings
            if case.case in study.discovery.walls
        },
    )


def _still(path: Path) -> Image.Image | None:
    """Figure of the study for print, None if it was not drawn."""
    if not path.exists():
        return None
    with Image.open(path) as picture:
        return picture.convert("RGB")


def _fit(folder: Path, name: str, setting: Setting, first: str, truth: Mapping[str, float]) -> FittedCase:
    """Fit under a setting; the first iteration has the beat at the prior's mean."""
    calibration, verification = folder / name / "calibration", folder / name / "verification"
    discovery = folder / "discovery" / name
    noise_free, noise_aware = (
        read_posterior(calibration / f"posterior{kind}.json") for kind in ("", "_noise")
    )
    return FittedCase.of(
        read_case(verification / "errors.json"),
        (noise_free, noise_aware),
        truth,
        _sigma_beats(calibration, setting),
        beat_curves(
            read_beat(folder / first / "calibration" / "beats" / "0.json"),
            setting.sensors(noise_free.prior.physical()),
        ),
        beat_curves(read_beat(verification / "beat.json"), setting.sensors(noise_free.estimate.physical())),
        read_simulated_motion(verification / "motion.npz"),
        (_diagnosis(discovery / "search"), _diagnosis(discovery)),
    )


def _sigma_beats(folder: Path, setting: Setting) -> SigmaBeats:
    """Sigma points, and the curves that the sensors record of their beats."""
    around, points = read_sigma_points(folder / "points.json")
    beats = [
        beat_curves(read_beat(folder / "beats" / f"{point.index}.json"), setting.sensors(point.parameters))
        for point in points
    ]
    return SigmaBeats(around, points, beats)


def _diagnosis(folder: Path) -> Diagnosis | None:
    return read_diagnosis(folder) if (folder / "cause.json").exists() else None


def _tables(folder: Path) -> dict[str, ReportTable]:
    files = {name: folder / f"{name}.csv" for name in TITLES}
    return {name: ReportTable.of(name, _table(name, file)) for name, file in files.items() if file.exists()}


def _table(name: str, file: Path) -> pd.DataFrame:
    as_text: dict[str, Any] = {"dtype": str, "keep_default_na": False} if name in TABLES_OF_TEXT else {}
    return pd.read_csv(file, comment="#", **as_text)


def _provenance(results: Path, study: Study, cases: Mapping[str, Case]) -> Provenance:
    verified = {
        f"{case}, {setting}": read_fingerprint(results / case / setting / "verification" / "errors.json")
        for case in cases
        for setting in study.settings_of(cases[case])
    }
    numbers = hashlib.sha256((results / "tables" / "numbers.csv").read_bytes()).hexdigest()[:16]
    return Provenance(
        fingerprints={"tables/numbers.csv": numbers, **verified},
        seeds={name: str(case.seed) for name, case in cases.items() if case.seed is not None},
        versions={"Python": platform.python_version(), **{name: metadata.version(name) for name in PACKAGES}},
        settings={"study": study.model_dump_json(indent=1)},
    )

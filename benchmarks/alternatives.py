"""Calibration methods in 3-D and on the spheres of a finished study, ten minutes.

`--kept` reuses the results in 3-D on disk, such as after an interrupted run; `--small` omits 3-D.
"""

import json
import sys
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from itertools import chain

import numpy as np
import pandas as pd

from benchmarks.measured_table import store_table
from benchmarks.ventricles import FOLDER, ROOT, SIZES
from heartfit.calibration.unscented import CachedForward, Forward, Outcome
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.mesher import fill_wall
from heartfit.heart.activation.conduction import assign_activation
from heartfit.io.configuration import read_cases, read_study
from heartfit.io.figures import write_figure
from heartfit.io.files import write_text
from heartfit.io.tables import read_published
from heartfit.observation.beat import observe_beats
from heartfit.observation.operator import CurveFeatures
from heartfit.personalise.run import run_beat
from heartfit.personalise.setting import Setting
from heartfit.results.race import POOLED, plot_race, race_table
from heartfit.results.text import cell_texts
from heartfit.study.case import Case
from heartfit.study.study import Study
from heartfit.synthetic.race import CalibrationProblem, MethodScore, compare_methods, methods
from heartfit.synthetic.volunteer import generate, hide_heart

HEARTS, SETTING, SIZE = ("volunteer1", "volunteer3"), "physical", "3k"
TABLES = "alternatives", "coverage_sphere"
SOLID = "volume, in 3-D"
"""Comparison on two volunteers in 3-D."""
SIMULATIONS, STEPS = 32, 2
"""Simulations of a heart in 3-D, where a beat takes seconds."""


def main(arguments: list[str]) -> None:
    study = read_study([ROOT / "config" / "config.yaml"])
    cases = {case.case: case for case in read_cases(ROOT / study.cases)}
    spheres, shares = (read_published(ROOT / study.results / "tables" / f"{name}.csv") for name in TABLES)
    marks = (
        [] if "--small" in arguments else [kept(study, cases[name], "--kept" in arguments) for name in HEARTS]
    )
    table = pd.concat([spheres, race_table({SOLID: list(chain(*marks))})], ignore_index=True)
    write_figure(ROOT / "docs" / "figures" / "alternatives.png", plot_race(table))
    module = " ".join(("benchmarks.alternatives", *arguments))
    store_table("calibration_methods", cell_texts(table), module)
    store_table("interval_coverage", cell_texts(pooled(shares)), module)


def pooled(shares: pd.DataFrame) -> pd.DataFrame:
    """Coverage over all parameters, by measurement, unknowns and noise."""
    return shares[shares["parameter"] == POOLED].drop(columns=["parameter", "hearts"])


def kept(study: Study, case: Case, again: bool) -> list[MethodScore]:
    """Scores of a heart, from disk if allowed and available."""
    file = FOLDER / "alternatives" / f"{case.case}.json"
    if not (again and file.exists()):
        write_text(file, json.dumps([asdict(mark) for mark in raced(study, case)]))
    return [MethodScore(**mark) for mark in json.loads(file.read_text())]


def raced(study: Study, case: Case) -> list[MethodScore]:
    """Compare the methods on one volunteer, whose volume is measured without images but with their noise."""
    problem = problem_of(study, case)
    return compare_methods(problem, methods(SIMULATIONS, STEPS), SIMULATIONS, HEARTS.index(case.case))


def problem_of(study: Study, case: Case) -> CalibrationProblem:
    """Beat of the hidden heart of a case: the calibrator's mesh, but other valves and a finer time step."""
    setting, pressures = study.setting(SETTING), study.end_diastolic_pressure
    hidden = hide_heart(study.cohort.heart, case.hidden, case.period, case.seed or 0)
    volunteer = generate(
        fill_wall(case.shape().surface(), *SIZES[SIZE]), hidden, study.cohort.protocol(pressures)
    )
    features = {"lv_volume": study.observation.trial_features(study.observation.frames)["lv_volume"]}
    (true,) = observe_beats([volunteer.beat], features)
    if isinstance(true, str):
        raise RuntimeError(f"{case.case}: {true}")
    sd = np.array([study.sphere_study.noise[name] for name in true])
    observed_values = np.array(list(true.values())) * (
        1.0 + sd * np.random.default_rng(case.seed).standard_normal(len(sd))
    )
    prior = setting.gaussian()
    return CalibrationProblem(
        CachedForward(solid(study, setting, case, assign_activation(volunteer.mesh), features)),
        prior,
        dict(zip(true, observed_values.tolist(), strict=True)),
        np.diag(np.square(sd * observed_values)),
        np.log([volunteer.truth[name] for name in prior.names]),
    )


def solid(
    study: Study,
    setting: Setting,
    case: Case,
    mesh: VentricularMesh,
    features: Mapping[str, CurveFeatures],
) -> Forward:
    """The calibrator's model in 3-D."""

    def forward(parameters: Sequence[Mapping[str, float]]) -> list[Outcome]:
        sys.stdout.write("." * len(parameters))
        sys.stdout.flush()
        beats = (
            run_beat(mesh, setting, case.period, entry, study.end_diastolic_pressure, study.numerics)
            for entry in parameters
        )
        return list(observe_beats(beats, features))

    return forward


if __name__ == "__main__":
    main(sys.argv[1:])

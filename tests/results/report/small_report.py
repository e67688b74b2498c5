"""Results of a study small enough for a test: two coarse hearts under two settings, closed forms instead of beats."""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import sigma_points
from heartfit.calibration.update import Posterior, calibrate
from heartfit.discovery.sphere_model.cause import Cause, Diagnosis, Gain, Refitted, Trace
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.observation.beat import BeatPhases
from heartfit.observation.curve import Curve
from heartfit.results.card import Card
from heartfit.results.case import CaseResult
from heartfit.results.discovery import DiscoveryResult
from heartfit.results.report.record import CaseRecord, FittedCase, Provenance, ReportTable, StudyRecord
from heartfit.results.wall_summary import UnseenEffect, WallSummary
from heartfit.synthetic.campaign import Effect

PERIOD, FRAMES, SETTING = 0.8, 10, "physical"
TIMES = np.arange(FRAMES) * PERIOD / FRAMES
PRIOR = Gaussian.from_relative({"sigma_0": 240e3, "mu": 7e3}, {"sigma_0": 0.2, "mu": 0.3})
UNITS = {"sigma_0": "Pa", "mu": "Pa.s"}
WAVE = 0.5 - 0.5 * np.cos(2.0 * np.pi * TIMES / PERIOD)


def volumes(least: float) -> dict[str, Curve]:
    """Both ventricles, from 150 mL down to ``least`` mL."""
    return {
        f"{side}_volume": Curve(TIMES, 1e-6 * (150.0 - (150.0 - least) * WAVE), PERIOD)
        for side in ("lv", "rv")
    }


def with_pressure(curves: Mapping[str, Curve]) -> dict[str, Curve]:
    return {**curves, "lv_pressure": Curve(TIMES, 1e3 + 14e3 * WAVE, PERIOD)}


def posterior(noise: float) -> Posterior:
    outcomes = [{"V_min": 1e-4 * float(np.exp(point.z @ [-0.3, 0.1]))} for point in sigma_points(PRIOR)]
    return calibrate(PRIOR, outcomes, {"V_min": outcomes[1]["V_min"]}, np.array([[noise**2]]))


def result(case: str, step: float | None) -> CaseResult:
    """Errors of a heart; with a step of sigma_0 in prior standard deviations, its estimate lies there."""
    noise_free = posterior(0.0)
    estimate = noise_free.estimate.physical()
    if step is not None:
        estimate["sigma_0"] = 240e3 * float(np.exp(0.2 * step))
    return CaseResult(
        case, SETTING, "abc", {"V_min": 6e-5}, {"V_min": 2e-6}, {"V_min": 9e-5}, {"V_min": 6.3e-5},
        PRIOR.physical(), dict(zip(PRIOR.names, PRIOR.sd, strict=True)),
        estimate, dict(zip(PRIOR.names, noise_free.estimate.sd, strict=True)),
        UNITS, 0, 5, shift=0.02,
    )  # fmt: skip


def diagnosis(name: str = "MitralRegurgitation") -> Diagnosis:
    """A leak that is named and proved, with one curve."""
    cause = Cause(name, 12.0, 3e-5, "m^2", (2e-5, 4e-5))
    flat = np.full(FRAMES, 1e3)
    trace = Trace("lv_pressure", TIMES, 9e3 * WAVE, 1e4 * WAVE, 9.1e3 * WAVE, flat, -3.0 * flat, flat)
    return Diagnosis(
        "named", (cause,), (("SlowRelaxation",),), "the volume with raised legs",
        (Gain("lv_pressure", "legs_raised", 900.0, 450.0, 0.5, (0.4, 0.7)),), 900, PERIOD, 7.0,
        ranking={name: 12.0, "SlowRelaxation": 3.0}, traces=(trace,),
        refitted=Refitted((cause,), 9.0, PRIOR.physical(), PRIOR.physical(), 40, True),
        unsearched={"rv_volume": "the sphere of the search has no right ventricle"},
        phases=BeatPhases(np.array([0.0, 0.06, 0.3, 0.36, 0.55, 0.65]), PERIOD), self_test=0.4,
    )  # fmt: skip


def beating(mesh: VentricularMesh, least: float) -> Motion:
    """The mesh shrinks towards its centre and comes back."""
    size = 1.0 - (1.0 - least) * WAVE
    centre = mesh.points.mean(axis=0)
    return Motion(TIMES, PERIOD, centre + size[:, None, None] * (mesh.points - centre))


def fit(mesh: VentricularMesh, case: str, failed: bool = False, diagnosed: bool = False) -> FittedCase:
    card = Card(case, SETTING, posterior(0.0), posterior(2e-6), {} if failed else {"sigma_0": 250e3})
    curves = {} if failed else with_pressure(volumes(63.0))
    return FittedCase(
        result=result(case, 3.2 if failed else None),
        card=card,
        reference=with_pressure(volumes(90.0)),
        calibrated=curves,
        band={name: Curve(TIMES, 0.02 * curve.values, PERIOD) for name, curve in curves.items()},
        motion=None if failed else beating(mesh, 0.85),
        searched=diagnosis() if diagnosed else None,
        proved=diagnosis() if diagnosed else None,
    )


def wall() -> WallSummary:
    """A septal scar that is named, and an effect that these data would show from some size."""
    unseen = UnseenEffect("delayed activation", "delay of the activation", "18 ms", "not shown")
    probability = np.where(np.isin(np.arange(17), (1, 2, 7, 8)), 0.9, 0.1).tolist()
    sentence = "Missing mechanism: scar, in mid anteroseptal (ln Bayes factor 19.3)."
    evidence = {"scar": 19.3, "smooth discrepancies of all curves": -12.0}
    return WallSummary("The wall", "named", sentence, evidence, "scar", True, probability, [unseen])


def study(mesh: VentricularMesh, name: str = "heart1", note: str = "") -> StudyRecord:
    """A catheterised heart whose cause is proved, and one without pressure whose calibrated beat failed."""
    motion = beating(mesh, 0.8)
    sound, weak = {SETTING: fit(mesh, name, diagnosed=True)}, {SETTING: fit(mesh, "heart2", failed=True)}
    cases = [
        CaseRecord(
            name,
            "virtual",
            "lbbb",
            mesh,
            motion,
            with_pressure(volumes(60.0)),
            [],
            sound,
            walls={SETTING: wall()},
        ),
        CaseRecord("heart2", "measured", "healthy", mesh, motion, volumes(60.0), [], weak),
    ]
    rows = {
        "setting": [SETTING, "Marchesseau et al. 2012"],
        "case": [name, "volunteer 1"],
        "V_min (%)": [5.0, 0.35],
    }
    tables = {"table1": ReportTable("Errors", pd.DataFrame(rows), note)}
    origin = Provenance({"heart1": "abc"}, {"heart1": "8"}, {"heartfit": "0.1.0"}, {"study": "mesh: {}"})
    hidden = Effect("MitralRegurgitation", 3.5e-5, 0.0, "m^2", 2.8)
    discoveries = [DiscoveryResult(name, SETTING, diagnosis(), diagnosis(), (hidden,), {"sigma_0": 2e5})]
    return StudyRecord({case.name: case for case in cases}, (SETTING,), tables, origin, note, discoveries)

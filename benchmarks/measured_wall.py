"""Search the wall of the measured heart for scar and late activation: python -m benchmarks.measured_wall RESULTS

RESULTS: results/measured_heart of config/measured_heart.yaml, of which mesh, motion and curves are read. Volumes of
both ventricles and the strain of the wall are searched; no pressure was recorded. Stores measured_wall.tsv and its
bull's-eye in docs; some ten minutes.
"""

import sys
from dataclasses import replace
from pathlib import Path

import pandas as pd

from benchmarks.measured_table import store_table
from benchmarks.ventricles import ROOT
from heartfit.discovery.refit.model import activate
from heartfit.discovery.wall_model.forward_model import WallForwardModel
from heartfit.discovery.wall_model.search import WallFindings, search_wall
from heartfit.discovery.wall_model.territory import probability_of_segments
from heartfit.discovery.wall_model.wall_data import WallRecording
from heartfit.heart.heart import Heart
from heartfit.io.configuration import read_study
from heartfit.io.figures import write_figure
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.refits import read_measured_case
from heartfit.io.regional_noise import read_regional_noise
from heartfit.mechanisms.mitral_dynamics import MitralDynamics
from heartfit.mechanisms.relaxed_friction import RelaxedFriction
from heartfit.results.bullseye import plot_bullseye

CONFIGURATION = [ROOT / "config" / "config.yaml", ROOT / "config" / "measured_heart.yaml"]
CASE, SETTING = "patient1", "physical"
NAMED = (MitralDynamics(), RelaxedFriction())
"""Mechanisms that the search of the left volume named, of their declared sizes."""
REGIONAL = ("Scar", "DelayedActivation")
FIGURE = ROOT / "docs" / "figures" / "measured_wall_bullseye.png"


def main(arguments: list[str]) -> int:
    """Search the heart and store table and figure."""
    if len(arguments) != 1:
        sys.stderr.write(f"{__doc__}\n")
        return 2
    recording, model = measured_wall(Path(arguments[0]) / CASE)
    findings = search_wall(model, recording)
    store_table("measured_wall", table(findings), "benchmarks.measured_wall results/measured_heart")
    singles = findings.survey.singles
    panels = [(name, probability_of_segments(singles, name)) for name in REGIONAL if name in findings.gains]
    if panels:
        write_figure(FIGURE, plot_bullseye(panels, "probability of a segment, if it is present"))
    return 0


def measured_wall(case: Path) -> tuple[WallRecording, WallForwardModel]:
    """Read what was measured of the heart, and its model with the mechanisms that its left volume named."""
    study = read_study(CONFIGURATION)
    files = {
        "measured": case / "curves" / "measured.csv",
        "second": [case / "curves" / "blood_volume.csv"],
    }
    curves = read_measured_case(files).recording()
    mesh = activate(read_mesh(case / "geometry" / "mesh.vtu"))
    motion = read_motion(case / "registration" / "motion.npz")
    recording = WallRecording(curves, mesh, motion, read_regional_noise())
    heart: Heart = study.setting(SETTING).base_heart(curves.period)
    for mechanism in NAMED:
        heart = heart + mechanism
    numerics = replace(study.numerics.numerics(), drift=3e-3, max_beats=8, keep_positions=True)
    return recording, WallForwardModel.at_samples(recording, heart, study.end_diastolic_pressure, numerics)


def table(findings: WallFindings) -> pd.DataFrame:
    """Return the ln Bayes factor of every fitted effect over the baseline, and that of smooth discrepancies."""
    best = findings.gains
    linear: dict[str, float] = {}
    for one in findings.screened:
        linear.setdefault(one.effect, one.log_bayes_factor)
    rows = [
        {
            "effect": name,
            "ln B": f"{best[name]:.1f}" if name in best else "",
            "ln B, linear": f"{linear[name]:.1f}",
        }
        for name in linear
    ]
    rows.append(
        {
            "effect": "smooth discrepancies",
            "ln B": f"{findings.discrepancy:.1f}",
            "ln B, linear": "",
        }
    )
    rows.append({"effect": "verdict", "ln B": findings.decision.verdict, "ln B, linear": ""})
    return pd.DataFrame(rows)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

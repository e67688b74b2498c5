"""Search hearts for an effect with the strain of their wall: python -m benchmarks.wall_search

Hearts of the benchmark in three dimensions on seeds that nothing else uses, both sides of which pump the same volume:
another mesh, other valves and another time step than the search's, seen by a scanner and followed by registration. Each
is searched with a left ventricular pressure; one with an effect of a region also without, and one with any effect on
the sphere that is centred on one beat of its mesh. Stores docs/measured/wall_search*.tsv after each heart; a run
continues with the hearts that the table lacks, three to five minutes of a core for each.
"""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from benchmarks.in_turn import searched_in_turn, spread_evenly
from benchmarks.measured_table import read_table, store_table
from benchmarks.planted_ventricles import (
    balanced_ventricles,
    sphere_reference,
    wall_model,
    wall_recording,
)
from benchmarks.ventricles import ROOT
from benchmarks.wall_tables import WallResult, WallTrial, hearts_table, rates_table
from heartfit.discovery.inference.decide import Effects
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.searched_recording import NAMING_VERDICTS
from heartfit.discovery.wall_model.hypotheses import is_regional
from heartfit.discovery.wall_model.search import WallFindings, search_wall
from heartfit.discovery.wall_model.territory import (
    affected_segments,
    most_probable_angle,
    probability_of_segments,
)
from heartfit.discovery.wall_model.wall_data import WallRecording
from heartfit.geometry.territory import APEX
from heartfit.io.figures import write_figure
from heartfit.results.bullseye import plot_bullseye
from heartfit.roles import registered
from heartfit.synthetic.campaign import PlantedPlan, plantable
from heartfit.synthetic.case import REST, PlantedCase
from heartfit.synthetic.ventricles import ImagedBeat

MODULE, HEARTS = "benchmarks.wall_search", "wall_search_hearts"
FIGURE = ROOT / "docs" / "figures" / "wall_search_bullseye.png"
SEED, SOUND_SEED, SCALES = 460600, 460450, 2.0
SOUND, SCARRED, LATE = 50, 14, 2
DRAWN = SEED + 1
"""Seed of the heart that is drawn: the first scar that is named."""


def main() -> None:
    """Search the hearts that the table lacks, and store it and the rates after each."""
    stored = read_table(HEARTS)
    known = set() if stored.empty else set(stored["seed"].astype(int))
    missing = [plan for plan in plans() if plan.seed not in known]
    for searched in searched_in_turn(search, missing, hearts_table):
        hearts = pd.concat([stored, hearts_table(searched).astype(str)])
        store_table(HEARTS, hearts, MODULE)
        store_table("wall_search", rates_table(hearts), MODULE)
        if searched[-1].seed == DRAWN:
            write_figure(FIGURE, _bullseye(searched[-1]))


def _bullseye(trial: WallTrial) -> Figure:
    """Draw the segments of a planted scar beside their probabilities."""
    panels = [("planted", np.asarray(trial.affected, dtype=float))]
    for title, result in (("with a pressure", trial.pressure), ("images alone", trial.images)):
        probability = None if result is None else result.probability
        panels.append((title, np.zeros(APEX) if probability is None else probability))
    return plot_bullseye(panels, "probability of a scar")


def plans() -> list[PlantedPlan]:
    """Return the planned hearts: scars, late walls, every other effect once, and sound ones, each spread evenly."""
    others = [name for name, kind in plantable(sides=2).items() if not is_regional(kind)]
    kinds = [["Scar"] * SCARRED, ["DelayedActivation"] * LATE, others]
    hidden = [
        [
            PlantedPlan(SEED + 100 * kind + place, "single", (name,), SCALES)
            for place, name in enumerate(names)
        ]
        for kind, names in enumerate(kinds)
    ]
    return spread_evenly(
        [*hidden, [PlantedPlan(SOUND_SEED + place, "none", (), 0.0) for place in range(SOUND)]]
    )


def search(plan: PlantedPlan) -> WallTrial:
    """Search a planted heart."""
    imaged, case = balanced_ventricles().plant(plan)
    recording, name = wall_recording(imaged, case), "".join(plan.names)
    alone = bool(name) and is_regional(registered()[name])
    return WallTrial(
        plan.seed,
        name,
        plan.scales,
        *_territory(case),
        _search(recording),
        _search(recording.without_pressure()) if alone else None,
        _on_the_sphere(imaged, case) if name else None,
    )


def _search(recording: WallRecording) -> WallResult:
    return _result(search_wall(wall_model(recording), recording))


def _territory(case: PlantedCase) -> tuple[float | None, np.ndarray | None]:
    """Angle [rad] and affected segments (17,) of a hidden effect of a region."""
    for effect in case.answer.effects:
        if "angle" in effect.others:
            angle = effect.others["angle"]
            return angle, affected_segments(angle, effect.others.get("share", effect.amplitude))
    return None, None


def _result(findings: WallFindings) -> WallResult:
    singles, best = findings.survey.singles, findings.regional
    return WallResult(
        findings.decision.verdict,
        findings.gains,
        findings.discrepancy,
        most_probable_angle(singles, best) if best else None,
        probability_of_segments(singles, best) if best else None,
        findings.beats,
        findings.cpu,
    )


def _on_the_sphere(imaged: ImagedBeat, case: PlantedCase) -> Effects:
    """Names by the search on a sphere that is centred on one beat of the mesh."""
    diagnosed = sphere_reference(imaged).search(Recording.from_curves(case.curves[REST]))
    names = tuple(cause.name for cause in diagnosed.mechanisms)
    return names if diagnosed.verdict in NAMING_VERDICTS else ()


if __name__ == "__main__":
    main()

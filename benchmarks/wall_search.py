"""Search hearts for an effect with the strain of their wall: python -m benchmarks.wall_search

Hearts of the benchmark in three dimensions on seeds that nothing else uses: another mesh, other valves and another time
step than the search's, seen by a scanner and followed by registration. Each is searched with a left ventricular
pressure and without one, and on the sphere that is centred on one beat of its mesh. Finished hearts stay on disk, in
.benchmarks. Stores docs/measured/wall_search*.tsv; seven minutes of a core for each heart.
"""

import numpy as np
from matplotlib.figure import Figure

from benchmarks.in_turn import kept_on_disk, searched_in_turn, spread_evenly
from benchmarks.measured_table import store_table
from benchmarks.planted_ventricles import sphere_reference, ventricles, wall_model, wall_recording
from benchmarks.ventricles import FOLDER, ROOT
from heartfit.discovery.inference.decide import Effects
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.searched_recording import NAMING_VERDICTS
from heartfit.discovery.wall_model.search import WallFindings, search_wall
from heartfit.discovery.wall_model.territory import (
    affected_segments,
    most_probable_angle,
    probability_of_segments,
)
from heartfit.geometry.territory import APEX
from heartfit.io.tables import write_figure
from heartfit.results.bullseye import plot_bullseye
from heartfit.results.wall_search import WallResult, WallTrial, hearts_table, rates_table
from heartfit.synthetic.campaign import PlantedPlan
from heartfit.synthetic.case import REST, PlantedCase
from heartfit.synthetic.ventricles import ImagedBeat

MODULE = "benchmarks.wall_search"
FIGURE = ROOT / "docs" / "figures" / "wall_search_bullseye.png"
SEED, SCALES = 450000, 2.0
SOUND, SCARRED, LATE = 12, 10, 2
OTHERS = ("MitralRegurgitation", "AorticStenosis", "CatheterOffset", "ImageTriggerDelay")


def main() -> None:
    """Search all hearts and store the tables."""
    for searched in searched_in_turn(search, plans(), hearts_table):
        store_table("wall_search_hearts", hearts_table(searched), MODULE)
        store_table("wall_search", rates_table(searched), MODULE)
        scarred = [trial for trial in searched if trial.effect == "Scar"]
        if scarred:
            write_figure(FIGURE, _bullseye(scarred[0]))


def _bullseye(trial: WallTrial) -> Figure:
    """Draw the segments of a planted scar beside their probabilities."""
    panels = [("planted", np.asarray(trial.affected, dtype=float))]
    for title, result in (("with a pressure", trial.pressure), ("images alone", trial.images)):
        probability = np.zeros(APEX) if result.probability is None else result.probability
        panels.append((title, probability))
    return plot_bullseye(panels, "probability of a scar")


def plans() -> list[PlantedPlan]:
    """Return the planned hearts, each kind spread evenly."""
    kinds = [["Scar"] * SCARRED, ["DelayedActivation"] * LATE, list(OTHERS), [""] * SOUND]
    seeds = iter(range(SEED, SEED + 1000))
    return spread_evenly([[_plan(next(seeds), name) for name in names] for names in kinds])


def _plan(seed: int, name: str) -> PlantedPlan:
    return PlantedPlan(seed, "single", (name,), SCALES) if name else PlantedPlan(seed, "none", (), 0.0)


def search(plan: PlantedPlan) -> WallTrial:
    """Search a planted heart, or read its outcome from disk."""
    return kept_on_disk(FOLDER / "wall_search" / f"{plan.seed}.pickle", lambda: _search(plan))


def _search(plan: PlantedPlan) -> WallTrial:
    imaged, case = ventricles().plant(plan)
    recording = wall_recording(imaged, case)
    alone = recording.without_pressure()
    findings = [search_wall(wall_model(one), one) for one in (recording, alone)]
    angle, affected = _territory(case)
    pressure, images = map(_result, findings)
    name = "".join(plan.names)
    return WallTrial(
        plan.seed, name, plan.scales, angle, affected, pressure, images, _on_the_sphere(imaged, case)
    )


def _territory(case: PlantedCase) -> tuple[float | None, np.ndarray | None]:
    """Angle [rad] and affected segments (17,) of a hidden effect of a region."""
    for effect in case.answer.effects:
        if "angle" in effect.others:
            angle = effect.others["angle"]
            return angle, affected_segments(angle, effect.others.get("share", effect.amplitude))
    return None, None


def _result(findings: WallFindings) -> WallResult:
    singles, best, decision = findings.survey.singles, findings.regional, findings.decision
    return WallResult(
        decision.verdict,
        decision.effects,
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

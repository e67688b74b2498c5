"""Computing time and memory of a study by stage, compared with the calibrations of the paper.

References
----------
Marchesseau et al. 2012, section 4: about 20 minutes a case, its 2n+1 simulations being run in parallel.
"""

import re
from collections.abc import Sequence
from itertools import groupby

import pandas as pd
from matplotlib.figure import Figure

from heartfit.results.figures import clean, colour
from heartfit.study.need import Cost

PAPER_MINUTES = 9 * 20.0
STAGES = {
    "kernels": r"^compile_kernels",
    "sensitivity": r"^sensitivity/",
    "registration error": r"^registration_error/",
    "spheres": r"^(compare_alternatives|cover_spheres)",
    "meshes": r"^templates/|/build_mesh$",
    "true beats": r"/(generate_volunteer|record_pressure)$",
    "images": r"/image_volunteer$",
    "registration": r"/(register|register_cine|extract_curves)$",
    "calibration": r"/(draw_sigma_points|simulate_point_\d+|update_parameters|simulate_calibrated)$",
}
"""Pattern of the job names of each stage."""

OTHER_STAGE, WHOLE_STUDY = "tables and figures", "whole study"
WALL, CPU, SHARE, MEMORY = "wall (s)", "CPU (s)", "share (%)", "largest memory (MB)"
AGAINST_PAPER = "of the paper's 9 x 20 min (%)"


def stage_of(job: str) -> str:
    """Return the stage of a job by its name."""
    return next((stage for stage, pattern in STAGES.items() if re.search(pattern, job)), OTHER_STAGE)


def cost_table(costs: Sequence[Cost]) -> pd.DataFrame:
    """Return one row per stage, the most expensive first, and the whole study: sums over jobs, largest memory.

    Jobs run in parallel: the study takes the sum of the wall times over the number of cores.
    """
    by_stage = groupby(sorted(costs, key=lambda cost: stage_of(cost.job)), lambda cost: stage_of(cost.job))
    whole = sum(cost.wall for cost in costs)
    rows = [_stage_row(stage, list(group), whole) for stage, group in by_stage]
    rows.sort(key=lambda row: -float(row[WALL]))
    return pd.DataFrame([*rows, _stage_row(WHOLE_STUDY, costs, whole)])


def calibration_time(costs: Sequence[Cost], case: str, setting: str) -> float:
    """Return the wall time [s] of a calibration whose simulations all run in parallel, as the paper counts it.

    Drawing of the points, the longest of the 2n+1 simulations, the update, and the simulation with the estimate; each
    includes the start of its job. NaN without such jobs.
    """
    walls = _walls(costs, case, setting)
    points = [wall for job, wall in walls.items() if job.startswith("simulate_point_")]
    others = [
        walls.get(job, float("nan"))
        for job in ("draw_sigma_points", "update_parameters", "simulate_calibrated")
    ]
    return max(points, default=float("nan")) + sum(others)


def number_of_updates(costs: Sequence[Cost], case: str, setting: str) -> int:
    """Return the number of updates that a calibration ran."""
    return sum(job.startswith("update_parameters") for job in _walls(costs, case, setting))


def _walls(costs: Sequence[Cost], case: str, setting: str) -> dict[str, float]:
    """Return the wall time [s] of the jobs of a case under a setting, by name."""
    folder = f"{case}/{setting}/"
    return {cost.job.removeprefix(folder): cost.wall for cost in costs if cost.job.startswith(folder)}


def _stage_row(stage: str, costs: Sequence[Cost], whole: float) -> dict[str, str | int | float]:
    wall = sum(cost.wall for cost in costs)
    return {
        "stage": stage,
        "jobs": len(costs),
        WALL: wall,
        CPU: sum(cost.cpu for cost in costs),
        SHARE: 100.0 * wall / whole,
        MEMORY: max(cost.memory for cost in costs),
        AGAINST_PAPER: 100.0 * wall / (60.0 * PAPER_MINUTES),
    }


def plot_costs(table: pd.DataFrame) -> Figure:
    """Plot the wall time and the CPU time of each stage as bars."""
    stages, whole = table[:-1][::-1], table.iloc[-1]
    figure = Figure(figsize=(6.5, 0.34 * len(stages) + 1.2), layout="constrained")
    axes = figure.subplots()
    for index, column in enumerate((WALL, CPU)):
        places = [place + 0.19 - 0.38 * index for place in range(len(stages))]
        axes.barh(places, stages[column] / 60.0, height=0.36, color=colour(index), label=column.split(" ")[0])
    labels = [f"{stage} ({jobs})" for stage, jobs in zip(stages["stage"], stages["jobs"], strict=True)]
    axes.set_yticks(range(len(stages)), labels)
    axes.set_xlabel("sum over jobs (min)")
    minutes = whole[WALL] / 60.0
    axes.set_title(f"{whole['jobs']} jobs, {minutes:.0f} min; paper: {PAPER_MINUTES:.0f} min", fontsize=10)
    axes.legend(frameon=False, fontsize=9, loc="lower right")
    clean(axes)
    return figure

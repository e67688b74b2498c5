"""Filling of the standard and the extended heart against normal values, two minutes; stores docs/measured/filling_*.

python -m benchmarks.filling MESH   MESH: a coarse mesh of the measured heart, patient1/geometry/mesh.vtu of a study
"""

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from functools import reduce
from operator import add
from pathlib import Path

import numpy as np

from benchmarks.filling_hearts import (
    HEARTS,
    alternated_costs,
    drawn_indices,
    indices,
    kept_prior,
    sphere_costs,
    sphere_curves,
)
from benchmarks.filling_tables import Measured, Range, tables
from benchmarks.measured_table import store_table
from benchmarks.ventricles import ROOT
from heartfit.heart.beat import Beat
from heartfit.heart.simulation import Numerics, simulate
from heartfit.io.configuration import read_cases, read_study
from heartfit.io.figures import write_figure
from heartfit.io.meshes import read_prepared_mesh
from heartfit.io.tables import read_published
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.observation.filling import volume_indices
from heartfit.observation.operator import cavity_indices
from heartfit.personalise.run import ventricles
from heartfit.results.filling import plot_filling
from heartfit.study.case import Case
from heartfit.study.study import Study

CASE, SETTING = "patient1", "physical"
SPHERE, SOLID = "sphere of the search", "coarse 3-D heart"
NUMERICS, REPEATS = Numerics(time_step=5e-3, max_beats=5, drift=0.01), 2
"""Numerics in 3-D, of shorter steps than trials have: 10 ms shorten isovolumic relaxation by 8 ms. Beats whose CPU
times give a median.
"""
NORMAL_FILLING = ROOT / "resources" / "normal_filling.csv"
NORMAL_VALUES = ROOT / ".." / "shared" / "data" / "normal_values" / "normal_values.csv"
CAVITY = {
    "EDV": ("LVEDV", "healthy men", 1e-6),
    "ESV": ("LVESV", "healthy men", 1e-6),
    "EF": ("LVEF", "MESA asymptomatic", 1e-2),
}
"""Cavity indices: quantity and group of the published table, and the SI value of its unit."""


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        sys.stderr.write(f"{__doc__}\n")
        return 2
    study = read_study([ROOT / "config" / "config.yaml"])
    (case,) = (case for case in read_cases(ROOT / study.cases) if case.case == CASE)
    volume, ranges = measured_volume(study, case), normal_ranges()
    limits = [entry.limit for entry in ranges]
    solid = run_in_3d(study, case, Path(arguments[0]))
    groups = {SPHERE: sphere_curves(), SOLID: solid.curves}
    measured = Measured(
        {
            group: {name: indices(curves) for name, curves in hearts.items()}
            for group, hearts in groups.items()
        },
        volume_indices(volume) | cavity_indices({"lv_volume": volume}),
        drawn_indices(),
        kept_prior(limits),
        {SPHERE: sphere_costs(), SOLID: solid.costs},
    )
    write_figure(ROOT / "docs" / "figures" / "filling.png", plot_filling(groups, {SOLID: volume}))
    for name, table in tables(measured, ranges).items():
        store_table(f"filling_{name}", table, "benchmarks.filling MESH")
    return 0


def normal_ranges() -> list[Range]:
    """Normal ranges: declared ones of filling, and two deviations about the published means of the cavity."""
    filling = [
        Range(row.quantity, row.low, row.high, f"{row.source}: {row.basis}")
        for row in read_published(NORMAL_FILLING).itertuples()
    ]
    return filling + [
        Range(name, low, high, source) for name, (low, high, source) in _cavity_ranges().items()
    ]


def _cavity_ranges() -> Mapping[str, tuple[float, float, str]]:
    table = read_published(NORMAL_VALUES).set_index(["quantity", "group"])
    ranges = {}
    for name, (quantity, group, unit) in CAVITY.items():
        row = table.loc[(quantity, group)]
        mean, sd = float(row["mean"]), float(row["sd"])
        basis = f"{row['source']}, {group}: {mean:g} +- {sd:g} {row['unit']} (two sd)"
        ranges[name] = unit * (mean - 2.0 * sd), unit * (mean + 2.0 * sd), basis
    return ranges


def measured_volume(study: Study, case: Case) -> Curve:
    """Left ventricular volume of the measured heart at its frames."""
    assert study.measured_heart is not None
    table = read_published(ROOT / study.measured_heart / "volumes.csv")
    return Curve.of_volume(table["time_s"], 1e-6 * table["lv_volume_ml"], case.period)


@dataclass(frozen=True, eq=False)
class Solid:
    """Curves and CPU time of a beat [s] by heart in 3-D."""

    curves: Mapping[str, Mapping[str, Curve]]
    costs: Mapping[str, float]


def run_in_3d(study: Study, case: Case, mesh_file: Path) -> Solid:
    """Beats of the setting at the mean of its prior, in turn, each heart unloaded for its own muscle."""
    mesh, loads = read_prepared_mesh(mesh_file), study.end_diastolic_pressure
    base = study.setting(SETTING).base_heart(case.period)
    hearts = {name: reduce(add, mechanisms, base) for name, mechanisms in HEARTS.items()}
    bodies = {
        name: ventricles(mesh, heart.muscle, np.array([loads.lv, loads.rv])) for name, heart in hearts.items()
    }
    beats: dict[str, Beat] = {}

    def run(name: str) -> Beat:
        beats[name] = simulate(hearts[name], bodies[name], NUMERICS)
        return beats[name]

    costs = alternated_costs({name: lambda name=name: run(name) for name in hearts}, REPEATS)
    return Solid({name: beat_curves(beat) for name, beat in beats.items()}, costs)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

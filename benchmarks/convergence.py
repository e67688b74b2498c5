"""Beats on finer meshes with shorter time steps, a quarter of an hour; stores docs/measured/convergence_*."""

import sys
from collections.abc import Iterator

import numpy as np

from benchmarks.beat import PERIOD
from benchmarks.measured_table import store_table
from benchmarks.ventricles import ROOT, mesh_file
from heartfit.io.configuration import read_study
from heartfit.io.meshes import read_mesh
from verification.convergence_of_beat import Row, mesh_table, rows_of, step_table

MESHES = ("3k", "6k", "10k", "30k")


def main() -> None:
    study = read_study([ROOT / "config" / "config.yaml"])
    heart = study.setting("physical").base_heart(PERIOD)
    loads = np.array([study.end_diastolic_pressure.lv, study.end_diastolic_pressure.rv])
    rows = list(announced(rows_of(heart, (read_mesh(mesh_file(name)) for name in MESHES), loads)))
    store_table("convergence_meshes", mesh_table(rows), "benchmarks.convergence")
    store_table("convergence_steps", step_table(rows), "benchmarks.convergence")


def announced(rows: Iterator[Row]) -> Iterator[Row]:
    """Yield the rows and print each one."""
    for row in rows:
        sys.stdout.write(f"{row.size.tetrahedra} tetrahedra, {row.scheme}, {1e3 * row.time_step:g} ms\n")
        sys.stdout.flush()
        yield row


if __name__ == "__main__":
    main()

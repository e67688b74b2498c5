"""Beats on successively finer meshes with shorter time steps; writes docs/convergence.md, a quarter of an hour."""

import sys
from collections.abc import Iterator

import numpy as np

from benchmarks.beat import PERIOD
from benchmarks.ventricles import ROOT, mesh_file
from heartfit.io.configuration import read_study
from heartfit.io.files import write_text
from heartfit.io.meshes import read_mesh
from verification.convergence_of_beat import Row, convergence_page, rows_of

MESHES = ("3k", "6k", "10k", "30k")


def main() -> None:
    study = read_study([ROOT / "config" / "config.yaml"])
    heart = study.setting("physical").base_heart(PERIOD)
    loads = np.array([study.end_diastolic_pressure.lv, study.end_diastolic_pressure.rv])
    rows = announced(rows_of(heart, (read_mesh(mesh_file(name)) for name in MESHES), loads))
    write_text(ROOT / "docs" / "convergence.md", convergence_page(list(rows)))


def announced(rows: Iterator[Row]) -> Iterator[Row]:
    """Yield the rows and print each one."""
    for row in rows:
        sys.stdout.write(f"{row.size.tetrahedra} tetrahedra, {row.scheme}, {1e3 * row.time_step:g} ms\n")
        sys.stdout.flush()
        yield row


if __name__ == "__main__":
    main()

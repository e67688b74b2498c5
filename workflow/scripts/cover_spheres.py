"""How often the intervals of a calibration hold the truth of spheres."""

from itertools import repeat
from pathlib import Path

from heartfit.io.log import record
from heartfit.io.tables import write_figure, write_table
from heartfit.tables.sphere_coverage import plot_sphere_coverage, sphere_coverage_table
from heartfit.twins.coverage import cover

record(snakemake.log[0])
given, out = snakemake.params, snakemake.output
covered = map(cover, given.twins.values(), repeat(given.study.covered))
seen = dict(zip(given.twins, covered, strict=True))
list(map(write_table, map(Path, out.table), repeat(sphere_coverage_table(seen))))
list(map(write_figure, map(Path, out.figure), repeat(plot_sphere_coverage(seen))))

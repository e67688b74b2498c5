"""Measure the coverage of a calibration's intervals on spheres of known truth."""

from itertools import repeat
from pathlib import Path

from heartfit.io.figures import write_figure
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.results.race import plot_sphere_coverage, sphere_coverage_table
from heartfit.results.text import render_table
from heartfit.synthetic.race import sphere_coverage

record(snakemake.log[0])
params, out = snakemake.params, snakemake.output
covered = map(sphere_coverage, params.samplers.values(), repeat(params.study.covered))
observed = dict(zip(params.samplers, covered, strict=True))
list(map(write_table, map(Path, out.table), repeat(render_table(sphere_coverage_table(observed)))))
list(map(write_figure, map(Path, out.figure), repeat(plot_sphere_coverage(observed))))

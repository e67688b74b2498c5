"""Compare methods of calibration at equal numbers of simulations, on spheres of known truth."""

from itertools import repeat
from pathlib import Path

from heartfit.io.figures import write_figure
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.results.race import plot_race, race_table
from heartfit.results.text import render_table
from heartfit.synthetic.race import compare_on_spheres

record(snakemake.log[0])
params, out = snakemake.params, snakemake.output
effort = map(repeat, (params.study.hearts, params.study.simulations, params.study.steps))
marks = map(compare_on_spheres, params.samplers.values(), *effort)
table = race_table(dict(zip(params.samplers, marks, strict=True)))
list(map(write_table, map(Path, out.table), repeat(render_table(table))))
list(map(write_figure, map(Path, out.figure), repeat(plot_race(table))))

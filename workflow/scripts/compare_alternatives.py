"""What else one could do at equal numbers of simulations, on spheres of known truth."""

from itertools import repeat
from pathlib import Path

from heartfit.io.log import record
from heartfit.io.tables import write_figure, write_table
from heartfit.tables.race_table import plot_race, race_table
from heartfit.twins.race import race_twins

record(snakemake.log[0])
given, out = snakemake.params, snakemake.output
effort = map(repeat, (given.study.hearts, given.study.simulations, given.study.steps))
marks = map(race_twins, given.twins.values(), *effort)
table = race_table(dict(zip(given.twins, marks, strict=True)))
list(map(write_table, map(Path, out.table), repeat(table)))
list(map(write_figure, map(Path, out.figure), repeat(plot_race(table))))

"""Which parameters are chosen, which prior the rule gives, and what Sobol's indices of the sphere say of both."""

from itertools import repeat
from pathlib import Path

from heartfit.io.log import record
from heartfit.io.plausibility import read_ranges, read_sobol
from heartfit.io.results import read_sensitivity
from heartfit.io.tables import write_figure, write_table
from heartfit.tables.prior_table import prior_table
from heartfit.tables.selection_table import selection_table
from heartfit.tables.sensitivity_table import bulk_modulus_table
from heartfit.tables.sobol_figure import plot_sobol
from heartfit.tables.sobol_table import sobol_table

record(snakemake.log[0])
files, out, given = snakemake.input, snakemake.output, snakemake.params
found = dict(zip(given.settings, map(read_sensitivity, map(Path, files.found)), strict=True))
ranges = dict(zip(given.settings, map(read_ranges, map(Path, files.ranges)), strict=True))
sobol = read_sobol(Path(files.sobol))
selection = selection_table(found, ranges, given.estimated)
list(map(write_table, map(Path, out.selection), repeat(selection)))
list(map(write_table, map(Path, out.prior), repeat(prior_table(ranges, found, given.units))))
bulk_modulus = bulk_modulus_table(found, given.units)
list(map(write_table, map(Path, out.bulk_modulus), repeat(bulk_modulus)))
list(map(write_table, map(Path, out.sobol), repeat(sobol_table(sobol))))
list(map(write_figure, map(Path, out.figure), repeat(plot_sobol(sobol, found))))

"""Tables 1 and 2 beside the paper's; the one place where the volunteers' truth is read."""

from itertools import repeat
from pathlib import Path

from heartfit.io.log import record
from heartfit.io.results import read_case, read_truth
from heartfit.io.tables import read_published, write_table
from heartfit.tables.errors_table import error_table
from heartfit.tables.parameters_table import parameter_table
from heartfit.tables.plausibility_table import plausibility_table

record(snakemake.log[0])
cases = list(map(read_case, map(Path, snakemake.input.cases)))
truths = dict(zip(snakemake.params.virtual, map(read_truth, map(Path, snakemake.input.truths)), strict=True))
errors, parameters = map(read_published, map(Path, snakemake.input.paper))
list(map(write_table, map(Path, snakemake.output.errors), repeat(error_table(cases, errors))))
table = parameter_table(cases, parameters, truths)
list(map(write_table, map(Path, snakemake.output.parameters), repeat(table)))
list(map(write_table, map(Path, snakemake.output.plausibility), repeat(plausibility_table(cases))))

"""Write the paper's Tables 1 and 2 as printed, with ours below in the same layout."""

from pathlib import Path

from heartfit.io.results import read_case
from heartfit.io.run import record
from heartfit.io.tables import read_published, write_tables
from heartfit.results.as_printed import printed_errors, printed_parameters
from heartfit.results.text import render_tables

record(snakemake.log[0])
cases = list(map(read_case, map(Path, snakemake.input.cases)))
errors, parameters = map(read_published, map(Path, snakemake.input.paper))
groups = snakemake.params.groups
tables = {
    "table1_as_printed": printed_errors(cases, errors, groups),
    "table2_as_printed": printed_parameters(cases, parameters, groups),
}
write_tables(Path(snakemake.output[0]).parent, render_tables(tables))

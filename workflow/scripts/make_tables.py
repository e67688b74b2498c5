"""Write Tables 1 to 3 with the paper's and in its layout, plausibility, and each number with its provenance."""

from pathlib import Path

from heartfit.io.results import read_case, read_truth
from heartfit.io.run import record
from heartfit.io.tables import read_published, write_csv, write_tables
from heartfit.results.as_printed import printed_tables
from heartfit.results.errors import error_table, plausibility_table
from heartfit.results.parameters import parameter_table
from heartfit.results.patients import patient_errors, patient_parameters
from heartfit.results.provenance import numbers_table
from heartfit.results.text import render_tables

record(snakemake.log[0])
files, origin = snakemake.input, snakemake.params.origin
groups = origin.groups
cases = [read_case(Path(file)) for file in files.cases]
truths = {name: read_truth(Path(file)) for name, file in zip(groups.virtual, files.truths, strict=True)}
errors, parameters, patients = map(read_published, map(Path, files.paper))
tables = {
    "table1": error_table(cases, errors, groups),
    "table2": parameter_table(cases, parameters, groups, truths),
    "table3": patient_errors(cases, patients, groups),
    "table3_parameters": patient_parameters(cases, patients, groups, truths),
}
printed = printed_tables(cases, errors, parameters, groups, truths, snakemake.params.planted_ratios)
folder = Path(snakemake.output.numbers).parent
write_tables(folder, render_tables(tables | printed | {"plausibility": plausibility_table(cases)}))
write_csv(Path(snakemake.output.numbers), numbers_table(tables, cases, origin))

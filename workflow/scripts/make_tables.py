"""Tables 1 to 3 beside the paper's, what guards them, and every number of them with its provenance."""

from pathlib import Path

from heartfit.io.log import record
from heartfit.io.results import read_case, read_truth
from heartfit.io.tables import read_published, write_table, write_tables
from heartfit.tables.errors_table import error_table
from heartfit.tables.parameters_table import parameter_table
from heartfit.tables.patients_table import patient_errors, patient_parameters
from heartfit.tables.plausibility_table import plausibility_table
from heartfit.tables.provenance import numbers_table

record(snakemake.log[0])
files, origin = snakemake.input, snakemake.params.origin
groups = origin.groups
cases = list(map(read_case, map(Path, files.cases)))
truths = dict(zip(groups.virtual, map(read_truth, map(Path, files.truths)), strict=True))
errors, parameters, patients = map(read_published, map(Path, files.paper))
tables = {
    "table1": error_table(cases, errors, groups),
    "table2": parameter_table(cases, parameters, groups, truths),
    "table3": patient_errors(cases, patients, groups),
    "table3_parameters": patient_parameters(cases, patients, groups, truths),
}
folder = Path(snakemake.output.numbers).parent
write_tables(folder, tables | {"plausibility": plausibility_table(cases)})
write_table(Path(snakemake.output.numbers), numbers_table(tables, cases, origin))

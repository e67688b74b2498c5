"""Compare the tables of the study with the stored ones; fails only if a stored finding is lost."""

from pathlib import Path

from heartfit.io.files import write_text
from heartfit.io.reference import machine, read_held_tables, read_reference
from heartfit.io.run import record
from heartfit.io.tables import write_csv
from heartfit.results.drift import drift_table
from heartfit.results.found import require_findings

record(snakemake.log[0])
params, output = snakemake.params, snakemake.output
stored, tables = read_reference(Path(params.reference)), read_held_tables(Path(params.tables))
drift = stored.compared(tables, machine())
write_csv(Path(output.table), drift_table(drift, params.left_out))
write_text(Path(output.line), drift.line(output.table, params.left_out) + "\n")
require_findings(stored.tables, tables)

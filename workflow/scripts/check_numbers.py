"""Compare the tables of the study with the stored ones; fails and lists the cells that drifted."""

from pathlib import Path

from heartfit.io.reference import machine, read_held_tables, read_reference
from heartfit.io.run import record
from heartfit.io.tables import write_csv
from heartfit.results.drift import drift_table

record(snakemake.log[0])
params = snakemake.params
stored, tables = read_reference(Path(params.reference)), read_held_tables(Path(params.tables))
places = {"tables": params.tables, "reference": params.reference}
table = drift_table(stored.compared(tables, machine()), places, params.left_out)
write_csv(Path(snakemake.output[0]), table)

"""Compare what was found of each refitted case with what a sealed heart hides."""

from pathlib import Path

from heartfit.io.discoveries import read_discoveries
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.results.discovery import discovery_table

record(snakemake.log[0])
params = snakemake.params
results = read_discoveries(Path(params.results), params.refitted, params.virtual)
table = discovery_table(results)
for file in snakemake.output:
    write_table(Path(file), table)

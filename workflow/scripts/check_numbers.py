"""Compare the study's numbers with their tolerances; fails and lists every number outside."""

from pathlib import Path

from heartfit.io.run import record
from heartfit.io.tables import read_numbers, read_tolerances, write_csv
from heartfit.results.provenance import require_no_drift

record(snakemake.log[0])
numbers, tolerances = (
    read_numbers(Path(snakemake.input.numbers)),
    read_tolerances(Path(snakemake.input.tolerances)),
)
write_csv(Path(snakemake.output[0]), require_no_drift(numbers, tolerances))

"""Hold what was said of effects hidden in 3-D to what is claimed of it; fails with every claim that is refuted."""

from pathlib import Path

from heartfit.io.run import record
from heartfit.io.scores import read_scored
from heartfit.io.tables import read_tolerances, write_csv
from heartfit.results.planted_table import require_claims

record(snakemake.log[0])
scored = read_scored(snakemake.input.findings, snakemake.input.sealed)
claims = read_tolerances(Path(snakemake.input.claims))
write_csv(Path(snakemake.output[0]), require_claims(scored, claims))

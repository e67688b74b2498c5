"""Compare the scores for effects hidden in 3-D with their claims; fails and lists every refuted claim."""

from pathlib import Path

from heartfit.io.run import record
from heartfit.io.scores import read_scored
from heartfit.io.tables import read_claims, write_csv
from heartfit.results.planted_table import require_claims

record(snakemake.log[0])
scored = read_scored(snakemake.input.findings, snakemake.input.sealed)
claims = read_claims(Path(snakemake.input.claims))
write_csv(Path(snakemake.output[0]), require_claims(scored, claims))

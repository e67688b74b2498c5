"""Search the causes of what the model misses in planted recordings, whose answers are not given."""

from pathlib import Path

from heartfit.io.findings import read_planted, write_findings
from heartfit.io.log import record
from heartfit.planting.trial import found

record(snakemake.log[0])
recordings = read_planted(Path(snakemake.input.measured))
findings = dict(zip(recordings, map(found, recordings.values()), strict=True))
write_findings(Path(snakemake.output[0]), findings, snakemake.params.code)

"""Search the causes of what the model misses in planted recordings, whose answers are not given."""

from pathlib import Path

from heartfit.io.findings import read_conditions_of, read_planted, write_findings
from heartfit.io.log import record
from heartfit.planting.trial import found_by_data

record(snakemake.log[0])
measured = Path(snakemake.input.measured)
recordings = read_planted(measured)
said = map(found_by_data, recordings.values(), read_conditions_of(measured))
findings = dict(zip(recordings, said, strict=True))
write_findings(Path(snakemake.output[0]), findings, snakemake.params.code)

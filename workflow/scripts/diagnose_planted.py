"""Diagnose planted recordings without access to the answers."""

from pathlib import Path

from heartfit.io.planted import read_conditions_of, read_planted, write_findings
from heartfit.io.run import record
from heartfit.synthetic.trial import diagnose_by_data

record(snakemake.log[0])
measured = Path(snakemake.input.measured)
recordings = read_planted(measured)
diagnoses = map(diagnose_by_data, recordings.values(), read_conditions_of(measured))
findings = dict(zip(recordings, diagnoses, strict=True))
write_findings(Path(snakemake.output[0]), findings, snakemake.params.code)

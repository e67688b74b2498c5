"""Diagnose planted recordings without access to the answers."""

from pathlib import Path

from heartfit.io.planted import read_conditions_of, read_planted, write_findings
from heartfit.io.run import record
from heartfit.synthetic.trial import diagnose_by_data

record(snakemake.log[0])
measured = Path(snakemake.input.measured)
recordings = read_planted(measured)
findings = {
    name: diagnose_by_data(recording, conditions)
    for (name, recording), conditions in zip(recordings.items(), read_conditions_of(measured), strict=True)
}
write_findings(Path(snakemake.output[0]), findings, snakemake.params.code)

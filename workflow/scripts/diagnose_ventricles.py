"""Diagnose planted ventricles on a sphere centred on one beat of their mesh."""

from pathlib import Path

from heartfit.discovery.refit.model import Reference
from heartfit.io.meshes import read_mesh
from heartfit.io.planted import read_planted, write_findings
from heartfit.io.run import record
from heartfit.synthetic.trial import diagnose_recording

record(snakemake.log[0])
files, params = snakemake.input, snakemake.params
mesh = read_mesh(Path(files.mesh))
reference = Reference(mesh, params.setting, params.pressures, params.model.numerics)
((seed, recording),) = read_planted(Path(files.measured)).items()
write_findings(
    Path(snakemake.output[0]), {seed: diagnose_recording(recording, reference.search)}, params.code
)

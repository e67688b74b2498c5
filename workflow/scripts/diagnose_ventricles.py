"""Search the cause of what the model misses in planted ventricles, on a sphere centred on one beat of their mesh."""

from pathlib import Path

from heartfit.io.findings import read_planted, write_findings
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh
from heartfit.planting.trial import found
from heartfit.proof.reference import Reference

record(snakemake.log[0])
files, given = snakemake.input, snakemake.params
mesh = read_mesh(Path(files.mesh))
reference = Reference(mesh, given.setting, given.pressures, given.model.numerics)
((seed, recording),) = read_planted(Path(files.measured)).items()
write_findings(Path(snakemake.output[0]), {seed: found(recording, reference.search)}, given.code)

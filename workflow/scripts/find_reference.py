"""Find the stress-free reference of a mesh measured at end diastole."""

from pathlib import Path

from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, write_mesh
from heartfit.protocol import stress_free

record(snakemake.log[0])
mesh = read_mesh(Path(snakemake.input[0]))
given = snakemake.params
write_mesh(Path(snakemake.output[0]), stress_free(mesh, given.setting, given.case.period, given.pressures))

"""Fill the wall of the measured heart at end diastole and give it fibres, segments and activation."""

from pathlib import Path

from heartfit.electrophysiology.onset import assign_activation
from heartfit.geometry.mesher import fill_wall
from heartfit.geometry.prepare import prepare
from heartfit.io.log import record
from heartfit.io.measured_heart import read_measured_heart
from heartfit.io.meshes import write_mesh

record(snakemake.log[0])
heart = read_measured_heart(Path(snakemake.params.folder))
size = snakemake.params.size
mesh = fill_wall(heart.surface, size.edge_length, size.tolerance)
write_mesh(Path(snakemake.output[0]), assign_activation(prepare(mesh)))

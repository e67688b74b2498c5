"""Fill the wall of the measured heart at end diastole and give it fibres, segments and activation."""

from pathlib import Path

from heartfit.electrophysiology.conduction import CONDUCTIONS
from heartfit.electrophysiology.onset import assign_activation
from heartfit.electrophysiology.personalise import personalised
from heartfit.geometry.mesher import fill_wall
from heartfit.geometry.prepare import prepare
from heartfit.io.log import record
from heartfit.io.meshes import write_mesh
from heartfit.io.sources import read_wall

record(snakemake.log[0])
wall = read_wall(snakemake.params.source)
case, size = snakemake.params.case, snakemake.params.size
mesh = prepare(fill_wall(wall, size.edge_length, size.tolerance))
conduction = personalised(mesh, CONDUCTIONS[case.conduction], case.qrs)
write_mesh(Path(snakemake.output[0]), assign_activation(mesh, conduction))

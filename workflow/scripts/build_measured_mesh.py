"""Fill the wall of the measured heart at end diastole and give it fibres, segments and activation."""

from pathlib import Path

from heartfit.geometry.fibres import prepare
from heartfit.geometry.mesher import fill_wall
from heartfit.heart.activation.conduction import CONDUCTIONS, assign_activation, fit_conduction
from heartfit.io.meshes import write_mesh
from heartfit.io.run import record
from heartfit.io.sources import read_wall

record(snakemake.log[0])
wall = read_wall(snakemake.params.source)
case, size = snakemake.params.case, snakemake.params.size
mesh = prepare(fill_wall(wall, size.edge_length, size.tolerance))
conduction = fit_conduction(mesh, CONDUCTIONS[case.conduction], case.qrs)
write_mesh(Path(snakemake.output[0]), assign_activation(mesh, conduction))

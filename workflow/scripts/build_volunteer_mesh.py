"""Fill the wall of a volunteer, as acquired at end diastole, with a mesh and a conduction of the calibrator's own."""

from pathlib import Path

from heartfit.electrophysiology.conduction import CONDUCTIONS
from heartfit.electrophysiology.onset import assign_activation
from heartfit.electrophysiology.personalise import personalised
from heartfit.geometry.mesher import fill_wall
from heartfit.geometry.prepare import prepare
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, write_mesh
from heartfit.registration.carry import boundary_surface

record(snakemake.log[0])
acquired = read_mesh(Path(snakemake.input.outline))
case, size = snakemake.params.case, snakemake.params.size
mesh = prepare(fill_wall(boundary_surface(acquired, acquired.points), size.edge_length, size.tolerance))
conduction = personalised(mesh, CONDUCTIONS[case.conduction], case.qrs)
write_mesh(Path(snakemake.output[0]), assign_activation(mesh, conduction))

"""Fill the wall of a volunteer, as acquired at end diastole, with a mesh of the calibrator's own."""

from pathlib import Path

from heartfit.electrophysiology.onset import assign_activation
from heartfit.geometry.mesher import fill_wall
from heartfit.geometry.prepare import prepare
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, write_mesh
from heartfit.registration.carry import boundary_surface

record(snakemake.log[0])
acquired = read_mesh(Path(snakemake.input.outline))
size = snakemake.params.size
mesh = fill_wall(boundary_surface(acquired, acquired.points), size.edge_length, size.tolerance)
write_mesh(Path(snakemake.output[0]), assign_activation(prepare(mesh)))

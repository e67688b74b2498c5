"""Draw a further volunteer, on whom registration is tried."""

from pathlib import Path

from heartfit.cohort.generate import draw_volunteer
from heartfit.cohort.template import Template
from heartfit.io.beats import write_beat
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, write_mesh, write_motion

record(snakemake.log[0])
given = snakemake.params
protocol = given.error.protocol(given.pressures)
size = given.error.mesh
template = Template(read_mesh(Path(snakemake.input.template)), size.edge_length, size.tolerance)
seed = given.error.seed + int(snakemake.wildcards.number)
volunteer = draw_volunteer(template, given.heart, seed, protocol)
write_mesh(Path(snakemake.output.mesh), volunteer.mesh)
write_motion(Path(snakemake.output.motion), volunteer.motion)
write_beat(Path(snakemake.output.beat), volunteer.beat, given.code)

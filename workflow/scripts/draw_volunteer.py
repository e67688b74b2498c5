"""Draw a volunteer that tests registration."""

from pathlib import Path

from heartfit.io.beats import write_beat
from heartfit.io.meshes import read_mesh, write_mesh, write_motion
from heartfit.io.run import record
from heartfit.synthetic.volunteer import Template, draw_volunteer

record(snakemake.log[0])
params = snakemake.params
protocol = params.error.protocol(params.pressures)
size = params.error.mesh
template = Template(read_mesh(Path(snakemake.input.template)), size.edge_length, size.tolerance)
seed = params.error.seed + int(snakemake.wildcards.number)
volunteer = draw_volunteer(template, params.heart, seed, protocol)
write_mesh(Path(snakemake.output.mesh), volunteer.mesh)
write_motion(Path(snakemake.output.motion), volunteer.motion)
write_beat(Path(snakemake.output.beat), volunteer.beat, params.code)

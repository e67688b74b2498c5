"""Draw a further volunteer, on whom registration is tried."""

from pathlib import Path

from heartfit.cohort.generate import draw_volunteer
from heartfit.io.beats import write_beat
from heartfit.io.log import record
from heartfit.io.meshes import write_mesh, write_motion

record(snakemake.log[0])
given = snakemake.params
protocol = given.error.protocol(given.pressures)
volunteer = draw_volunteer(given.heart, given.error.seed + int(snakemake.wildcards.number), protocol)
write_mesh(Path(snakemake.output.mesh), volunteer.mesh)
write_motion(Path(snakemake.output.motion), volunteer.motion)
write_beat(Path(snakemake.output.beat), volunteer.beat, given.code)

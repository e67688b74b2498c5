"""Generate a virtual volunteer: the wall and its beat, and the truth, kept apart."""

from pathlib import Path

from heartfit.cohort.generate import generate
from heartfit.cohort.hidden_heart import OTHER_CONDUCTIONS, hide_heart
from heartfit.cohort.template import Template
from heartfit.io.beats import write_beat
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, write_mesh, write_motion
from heartfit.io.results import write_result

record(snakemake.log[0])
given = snakemake.params
case, protocol = given.case, given.cohort.protocol(given.pressures)
hidden = hide_heart(given.cohort.heart, case.hidden, case.period, case.seed, case.planted())
size = given.cohort.mesh
template = Template(read_mesh(Path(snakemake.input.template)), size.edge_length, size.tolerance)
conduction = OTHER_CONDUCTIONS[case.conduction]
volunteer = generate(template.shaped(case.shape()), hidden, protocol, conduction, case.qrs)
write_mesh(Path(snakemake.output.mesh), volunteer.mesh)
write_motion(Path(snakemake.output.motion), volunteer.motion)
write_beat(Path(snakemake.output.beat), volunteer.beat, given.code)
write_result(Path(snakemake.output.truth), {"parameters": volunteer.truth}, given.code)

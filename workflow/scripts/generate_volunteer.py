"""Generate a virtual heart, with its hidden effect if it has one: wall, beat, and a separate file of the truth."""

from pathlib import Path

from heartfit.io.beats import write_beat
from heartfit.io.meshes import read_mesh, write_mesh, write_motion
from heartfit.io.results import write_result
from heartfit.io.run import record
from heartfit.io.seals import open_effects
from heartfit.synthetic.campaign import mechanism_of
from heartfit.synthetic.volunteer import OTHER_CONDUCTIONS, Template, generate, hide_heart

record(snakemake.log[0])
params = snakemake.params
case, protocol = params.case, params.cohort.protocol(params.pressures)
planted = [mechanism_of(effect) for effect in open_effects(snakemake.input.get("hidden", []))]
hidden = hide_heart(params.cohort.heart, case.hidden, case.period, case.seed, planted)
size = params.cohort.mesh
template = Template(read_mesh(Path(snakemake.input.template)), size.edge_length, size.tolerance)
conduction = OTHER_CONDUCTIONS[case.conduction]
volunteer = generate(template.deformed_to(case.shape()), hidden, protocol, conduction, case.qrs)
write_mesh(Path(snakemake.output.mesh), volunteer.mesh)
write_motion(Path(snakemake.output.motion), volunteer.motion)
write_beat(Path(snakemake.output.beat), volunteer.beat, params.code)
write_result(Path(snakemake.output.truth), {"parameters": volunteer.truth}, params.code)

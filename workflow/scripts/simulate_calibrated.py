"""Simulate one more beat, at the calibrated parameters, and keep its motion and the shape of it."""

from pathlib import Path

from heartfit.io.beats import write_beat
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.results import read_posterior
from heartfit.io.simulated_motion import write_simulated_motion
from heartfit.io.tables import write_table
from heartfit.protocol import run_beat
from heartfit.tables.shape_table import beat_shape_table

record(snakemake.log[0])
mesh = read_mesh(Path(snakemake.input.mesh))
parameters = read_posterior(Path(snakemake.input.posterior)).estimate.physical()
given = snakemake.params
arguments = (mesh, given.setting, given.case.period, parameters, given.pressures, given.scheme)
beat = run_beat(*arguments, keep_positions=True)
state, _, shape, motion = map(Path, snakemake.output)
write_beat(state, beat, given.code)
write_table(shape, beat_shape_table(mesh, beat))
write_simulated_motion(motion, beat, read_motion(Path(snakemake.input.registered)).times)

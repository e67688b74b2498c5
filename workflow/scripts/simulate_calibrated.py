"""Simulate the beat at the calibrated parameters and write its motion and shape."""

from pathlib import Path

from heartfit.io.beats import write_beat
from heartfit.io.meshes import read_mesh, read_motion, write_simulated_motion
from heartfit.io.results import read_posterior
from heartfit.io.run import record
from heartfit.io.tables import write_csv
from heartfit.personalise.run import run_beat
from heartfit.results.shape import beat_shape_table

record(snakemake.log[0])
mesh = read_mesh(Path(snakemake.input.mesh))
parameters = read_posterior(Path(snakemake.input.posterior)).estimate.physical()
params = snakemake.params
arguments = (mesh, params.setting, params.case.period, parameters, params.pressures, params.scheme)
beat = run_beat(*arguments, keep_positions=True)
state, _, shape, motion = map(Path, snakemake.output)
write_beat(state, beat, params.code)
write_csv(shape, beat_shape_table(mesh, beat))
write_simulated_motion(motion, beat, read_motion(Path(snakemake.input.registered)).times)

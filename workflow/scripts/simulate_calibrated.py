"""Simulate one more beat, at the calibrated parameters, and keep the shape of its motion."""

from pathlib import Path

from heartfit.io.beats import write_beat
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh
from heartfit.io.results import read_posterior
from heartfit.io.tables import write_table
from heartfit.protocol import run_beat
from heartfit.tables.shape_table import beat_shape_table

record(snakemake.log[0])
mesh = read_mesh(Path(snakemake.input.mesh))
parameters = read_posterior(Path(snakemake.input.posterior)).estimate.physical()
given = snakemake.params
arguments = (mesh, given.setting, given.case.period, parameters, given.pressures, given.scheme)
beat = run_beat(*arguments, keep_positions=True)
write_beat(Path(snakemake.output.beat), beat, given.code)
write_table(Path(snakemake.output.shape), beat_shape_table(mesh, beat))

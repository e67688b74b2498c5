"""Simulate one more beat, at the calibrated parameters."""

from pathlib import Path

from heartfit.io.beats import write_beat
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh
from heartfit.io.results import read_posterior
from heartfit.protocol import run_beat

record(snakemake.log[0])
mesh = read_mesh(Path(snakemake.input.mesh))
parameters = read_posterior(Path(snakemake.input.posterior)).estimate.physical()
given = snakemake.params
beat = run_beat(mesh, given.setting, given.case.period, parameters, given.pressures, given.scheme)
write_beat(Path(snakemake.output.beat), beat, given.code)

"""Simulate the beat at the mean of the prior and write its motion at the times of the measured frames."""

from pathlib import Path

from heartfit.io.meshes import read_mesh, read_motion, write_simulated_motion
from heartfit.io.run import record
from heartfit.personalise.run import run_beat

record(snakemake.log[0])
mesh, params = read_mesh(Path(snakemake.input.mesh)), snakemake.params
mean = params.setting.gaussian().physical()
arguments = (mesh, params.setting, params.case.period, mean, params.pressures, params.scheme)
beat = run_beat(*arguments, keep_positions=True)
times = read_motion(Path(snakemake.input.registered)).times
write_simulated_motion(Path(snakemake.output[0]), beat, times)

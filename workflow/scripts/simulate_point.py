"""Simulate the beat of one sigma point."""

from pathlib import Path

from heartfit.io.beats import write_beat
from heartfit.io.meshes import read_mesh
from heartfit.io.results import read_sigma_points
from heartfit.io.run import record
from heartfit.personalise.run import run_beat

record(snakemake.log[0])
mesh = read_mesh(Path(snakemake.input.mesh))
_, points = read_sigma_points(Path(snakemake.input.points))
parameters = points[int(snakemake.wildcards.point)].parameters
params = snakemake.params
beat = run_beat(mesh, params.setting, params.case.period, parameters, params.pressures, params.scheme)
write_beat(Path(snakemake.output.beat), beat, params.code)

"""Simulate the beats of all one-at-a-time perturbations of a setting."""

from pathlib import Path

from heartfit.io.beats import write_beat
from heartfit.io.meshes import read_mesh
from heartfit.io.results import read_sigma_points
from heartfit.io.run import record
from heartfit.personalise.run import beats_of_points

record(snakemake.log[0])
mesh, params = read_mesh(Path(snakemake.input.mesh)), snakemake.params
_, points = read_sigma_points(Path(snakemake.input.points))
beats = beats_of_points(mesh, params.setting, params.case.period, points, params.pressures, params.scheme)
for file, beat in zip(snakemake.output.beats, beats, strict=True):
    write_beat(Path(file), beat, params.code)

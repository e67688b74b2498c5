"""Carry the mesh of the measured heart through the phases of its surface."""

from pathlib import Path

from heartfit.geometry.carry import carry_mesh
from heartfit.io.meshes import read_mesh, write_motion
from heartfit.io.run import record
from heartfit.io.sources import read_heart

record(snakemake.log[0])
mesh = read_mesh(Path(snakemake.input.mesh))
heart = read_heart(snakemake.params.source)
motion = carry_mesh(mesh, heart.surface, heart.positions, heart.times, heart.period)
write_motion(Path(snakemake.output[0]), motion)

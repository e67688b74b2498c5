"""Carry the calibrator's mesh of a volunteer by the acquired motion."""

from pathlib import Path

from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, read_motion, write_motion
from heartfit.registration.carry import follow_mesh

record(snakemake.log[0])
mesh = read_mesh(Path(snakemake.input.mesh))
acquired = read_mesh(Path(snakemake.input.acquisition))
motion = read_motion(Path(snakemake.input.motion))
carried = follow_mesh(mesh, acquired.points, acquired.tets, motion.positions, motion.times, motion.period)
write_motion(Path(snakemake.output[0]), carried)

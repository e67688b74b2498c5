"""Mesh the wall of a measured case coarsely for its refits, with its motion and activation."""

from pathlib import Path

from heartfit.geometry.coarsen import coarsen
from heartfit.heart.activation.conduction import CONDUCTIONS, assign_activation, fit_conduction
from heartfit.io.meshes import read_mesh, read_motion, write_mesh, write_motion
from heartfit.io.run import record

record(snakemake.log[0])
files, case, size = snakemake.input, snakemake.params.case, snakemake.params.size
registered = read_motion(Path(files.motion))
mesh, motion = coarsen(read_mesh(Path(files.mesh)), registered, size.edge_length, size.tolerance)
conduction = fit_conduction(mesh, CONDUCTIONS[case.conduction], case.qrs)
write_mesh(Path(snakemake.output.mesh), assign_activation(mesh, conduction))
write_motion(Path(snakemake.output.motion), motion)

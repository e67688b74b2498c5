"""Compare the shape of the calibrated motion with that of the measured one."""

from itertools import repeat
from pathlib import Path

from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.run import record
from heartfit.io.tables import read_shape, write_figure, write_table
from heartfit.observation.shape import motion_shape
from heartfit.results.motion import end_systole_table, plot_shape, shape_table
from heartfit.results.text import render_table

record(snakemake.log[0])
files = snakemake.input
measured = motion_shape(read_mesh(Path(files.mesh)), read_motion(Path(files.motion)))
shapes = {"measured": shape_table(measured), "calibrated": read_shape(Path(files.calibrated))}
title = f"{snakemake.wildcards.case}, {snakemake.wildcards.setting} setting"
list(map(write_table, map(Path, snakemake.output.table), repeat(render_table(end_systole_table(shapes)))))
list(map(write_figure, map(Path, snakemake.output.figure), repeat(plot_shape(shapes, title))))

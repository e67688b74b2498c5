"""Compare the shape of the calibrated motion with that of the measured one."""

from itertools import repeat
from pathlib import Path

from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.tables import read_shape, write_figure, write_table
from heartfit.observation.shape import shape_of
from heartfit.tables.shape_figure import plot_shape
from heartfit.tables.shape_table import end_systole, shape_table

record(snakemake.log[0])
files = snakemake.input
measured = shape_of(read_mesh(Path(files.mesh)), read_motion(Path(files.motion)))
shapes = {"measured": shape_table(measured), "calibrated": read_shape(Path(files.calibrated))}
title = f"{snakemake.wildcards.case}, {snakemake.wildcards.setting} setting"
list(map(write_table, map(Path, snakemake.output.table), repeat(end_systole(shapes))))
list(map(write_figure, map(Path, snakemake.output.figure), repeat(plot_shape(shapes, title))))

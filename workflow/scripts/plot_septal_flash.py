"""Plot and tabulate the septal flash of the patients and a volunteer: true, registered and calibrated."""

from itertools import repeat
from pathlib import Path

from heartfit.io.figures import write_figure
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.run import record
from heartfit.io.tables import read_shape, write_table
from heartfit.observation.strain import wall_motion
from heartfit.results.septal_flash import flash_table, plot_walls, walls_by_case
from heartfit.results.text import render_table

record(snakemake.log[0])
files, params = snakemake.input, snakemake.params
true = map(wall_motion, map(read_mesh, map(Path, files.hearts)), map(read_motion, map(Path, files.true)))
meshes, motions = map(read_mesh, map(Path, files.meshes)), map(read_motion, map(Path, files.registered))
calibrated = map(read_shape, map(Path, files.calibrated))
walls = walls_by_case(params.cases, params.settings, true, map(wall_motion, meshes, motions), calibrated)
list(map(write_table, map(Path, snakemake.output.table), repeat(render_table(flash_table(walls)))))
list(map(write_figure, map(Path, snakemake.output.figure), repeat(plot_walls(walls, params.settings))))

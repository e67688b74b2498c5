"""The septal flash of the patients beside a volunteer: true, registered and calibrated motions, figure and table."""

from itertools import repeat
from pathlib import Path

from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.tables import read_shape, write_figure, write_table
from heartfit.observation.walls import walls_of
from heartfit.tables.walls_figure import plot_walls
from heartfit.tables.walls_table import flash_table, walls_by_case

record(snakemake.log[0])
files, given = snakemake.input, snakemake.params
true = map(walls_of, map(read_mesh, map(Path, files.hearts)), map(read_motion, map(Path, files.true)))
meshes, motions = map(read_mesh, map(Path, files.meshes)), map(read_motion, map(Path, files.registered))
calibrated = map(read_shape, map(Path, files.calibrated))
walls = walls_by_case(given.cases, given.settings, true, map(walls_of, meshes, motions), calibrated)
list(map(write_table, map(Path, snakemake.output.table), repeat(flash_table(walls))))
list(map(write_figure, map(Path, snakemake.output.figure), repeat(plot_walls(walls))))

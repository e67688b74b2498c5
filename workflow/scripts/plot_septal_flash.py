"""Plot and tabulate the septal flash of the patients and a volunteer: true, registered and calibrated."""

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
true = [
    wall_motion(read_mesh(Path(mesh)), read_motion(Path(motion)))
    for mesh, motion in zip(files.hearts, files.true, strict=True)
]
registered = [
    wall_motion(read_mesh(Path(mesh)), read_motion(Path(motion)))
    for mesh, motion in zip(files.meshes, files.registered, strict=True)
]
calibrated = [read_shape(Path(file)) for file in files.calibrated]
walls = walls_by_case(params.cases, params.settings, true, registered, calibrated)
table = render_table(flash_table(walls))
for file in snakemake.output.table:
    write_table(Path(file), table)
figure = plot_walls(walls, params.settings)
for file in snakemake.output.figure:
    write_figure(Path(file), figure)

"""Draw the calibrated simulation and the registered mesh over the images, at end diastole and end systole."""

from pathlib import Path

from heartfit.io.figures import write_figure
from heartfit.io.images import read_images
from heartfit.io.meshes import read_mesh, read_motion, read_simulated_motion
from heartfit.io.run import record
from heartfit.results.overlay import plot_overlay

record(snakemake.log[0])
files, names = snakemake.input, snakemake.wildcards
images, mesh = read_images(Path(files.images)), read_mesh(Path(files.mesh))
registered, calibrated = read_motion(Path(files.registered)), read_simulated_motion(Path(files.calibrated))
title, colour = f"{names.case}, {names.setting} setting", snakemake.params.colour
figure = plot_overlay(images, mesh, registered, calibrated, title, colour)
for file in snakemake.output:
    write_figure(Path(file), figure)

"""Draw the contours of the carried mesh over the images, at end diastole and end systole and beating."""

from pathlib import Path

from heartfit.io.figures import write_animation, write_figure
from heartfit.io.images import read_images
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.run import record
from heartfit.results.contours import animate_contours, plot_contours

record(snakemake.log[0])
files, case = snakemake.input, snakemake.wildcards.case
images, motion = read_images(Path(files.images)), read_motion(Path(files.motion))
arguments = (images, read_mesh(Path(files.mesh)), motion, case)
figure = plot_contours(*arguments)
for file in snakemake.output.figure:
    write_figure(Path(file), figure)
write_animation(Path(snakemake.output.animation), animate_contours(*arguments))

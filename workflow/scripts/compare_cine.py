"""Compare registered real short-axis images with the measured surface cut by the same planes."""

from itertools import repeat
from pathlib import Path

from heartfit.io.images import read_images
from heartfit.io.run import record
from heartfit.io.slice_motions import read_slice_motion
from heartfit.io.sources import read_heart
from heartfit.io.tables import write_figure, write_table
from heartfit.observation.cine import compare_cine
from heartfit.results.cine import (
    outline_table,
    plot_outlines,
    plot_volumes,
    short_axis_volume_table,
    wall_table,
)
from heartfit.results.text import render_table

record(snakemake.log[0])
files, output, case = snakemake.input, snakemake.output, snakemake.wildcards.case
heart, motion = read_heart(snakemake.params.source), read_slice_motion(Path(files.motion))
images = read_images(Path(files.images), heart.period, heart.times)
cine = compare_cine(heart.surface, heart.positions, heart.times, heart.period, motion)
list(map(write_table, map(Path, output.outlines), repeat(render_table(outline_table(cine)))))
list(map(write_table, map(Path, output.wall), repeat(render_table(wall_table(cine)))))
list(map(write_table, map(Path, output.volume), repeat(render_table(short_axis_volume_table(cine.volumes)))))
list(map(write_figure, map(Path, output.outlines_figure), repeat(plot_outlines(images, cine, case))))
list(map(write_figure, map(Path, output.volume_figure), repeat(plot_volumes(cine.volumes, case))))

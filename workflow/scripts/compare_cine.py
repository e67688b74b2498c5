"""Compare registered real short-axis images with the measured surface cut by the same planes."""

from pathlib import Path

from heartfit.io.figures import write_figures
from heartfit.io.images import read_images
from heartfit.io.run import record
from heartfit.io.slice_motions import read_slice_motion
from heartfit.io.sources import read_heart
from heartfit.io.tables import write_tables
from heartfit.observation.cine import compare_cine
from heartfit.results.cine import cine_figures, cine_tables
from heartfit.results.text import render_tables

record(snakemake.log[0])
files, output, case = snakemake.input, snakemake.output, snakemake.wildcards.case
heart, motion = read_heart(snakemake.params.source), read_slice_motion(Path(files.motion))
images = read_images(Path(files.images), heart.period, heart.times)
cine = compare_cine(heart.surface, heart.positions, heart.times, heart.period, motion)
write_tables(Path(output.wall[0]).parent, render_tables(cine_tables(cine, case)))
write_figures([*output.outlines_figure, *output.volume_figure], cine_figures(images, cine, case))

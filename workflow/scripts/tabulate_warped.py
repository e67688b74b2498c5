"""Tabulate and draw what registration recovers from real images that move as simulated."""

from itertools import repeat
from operator import attrgetter
from pathlib import Path

from heartfit.io.figures import write_figure
from heartfit.io.images import read_images
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.noise_models import read_comparison
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.results.text import render_table
from heartfit.results.warped_cine import plot_warped, warped_table

record(snakemake.log[0])
files, params, output = snakemake.input, snakemake.params, snakemake.output
comparisons = dict(zip(params.contents, map(read_comparison, map(Path, files.comparisons)), strict=True))
images = dict(zip(params.shown, map(read_images, map(Path, files.images)), strict=True))
paths = map(Path, (files.motion, *files.registered))
positions = map(attrgetter("positions"), map(read_motion, paths))
motions = dict(zip(("true", *params.shown), positions, strict=True))
operator = params.operator.trial_features(params.operator.frames)["lv_volume"]
list(map(write_table, map(Path, output.table), repeat(render_table(warped_table(comparisons)))))
figure = plot_warped(images, read_mesh(Path(files.mesh)), motions, comparisons, operator)
list(map(write_figure, map(Path, output.figure), repeat(figure)))

"""Tabulate and draw what registration recovers from real images that move as simulated."""

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
comparisons = {
    name: read_comparison(Path(file)) for name, file in zip(params.contents, files.comparisons, strict=True)
}
images = {name: read_images(Path(file)) for name, file in zip(params.shown, files.images, strict=True)}
motions = {
    name: read_motion(Path(file)).positions
    for name, file in zip(("true", *params.shown), (files.motion, *files.registered), strict=True)
}
operator = params.operator.trial_features(params.operator.frames)["lv_volume"]
table = render_table(warped_table(comparisons))
for file in output.table:
    write_table(Path(file), table)
figure = plot_warped(images, read_mesh(Path(files.mesh)), motions, comparisons, operator)
for file in output.figure:
    write_figure(Path(file), figure)

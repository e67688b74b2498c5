"""Tabulate the errors of registration by acquisition and by segment, and draw Fig. 6."""

from pathlib import Path

from heartfit.io.figures import write_figure
from heartfit.io.noise_models import read_comparison
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.results.acquisitions import Acquisitions
from heartfit.results.registration import plot_registration, registration_table, segment_table
from heartfit.results.text import render_table

record(snakemake.log[0])
params, out = snakemake.params, snakemake.output
acquisitions = Acquisitions.of(
    params.settings, params.tried, map(read_comparison, map(Path, snakemake.input))
)
costs = render_table(registration_table(acquisitions))
for file in out.costs:
    write_table(Path(file), costs)
segments = render_table(segment_table(acquisitions.baseline))
for file in out.segments:
    write_table(Path(file), segments)
figure = plot_registration(acquisitions, params.operator.trial_features(params.frames)["lv_volume"])
for file in out.figure:
    write_figure(Path(file), figure)

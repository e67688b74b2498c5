"""Plot and tabulate the effect of each parameter for one setting: curves, covariances and their decomposition."""

from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.figures import write_figure
from heartfit.io.results import read_sensitivity, read_sigma_points
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.personalise.run import curves_of_points
from heartfit.results.figures import plot_perturbations
from heartfit.results.sensitivity import plot_sensitivities, sensitivity_table
from heartfit.results.text import render_table

record(snakemake.log[0])
files, out, params = snakemake.input, snakemake.output, snakemake.params
_, points = read_sigma_points(Path(files.points))
beats = map(read_beat, map(Path, files.beats))
outcome = read_sensitivity(Path(files.sensitivity))
title = f"{params.study.case}, {snakemake.wildcards.setting} setting"
curves = plot_perturbations(
    curves_of_points(params.setting, points, beats), outcome.parameters, title, params.study.step
)
for file in out.curves:
    write_figure(Path(file), curves)
figure = plot_sensitivities(outcome, title)
for file in out.figure:
    write_figure(Path(file), figure)
table = render_table(sensitivity_table(outcome, params.setting.units()))
for file in out.table:
    write_table(Path(file), table)

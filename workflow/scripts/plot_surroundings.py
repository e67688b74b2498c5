"""Plot and tabulate what each parameter does under one setting: curves, covariances and their decomposition."""

from itertools import repeat
from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.log import record
from heartfit.io.results import read_sensitivity, read_sigma_points
from heartfit.io.tables import write_figure, write_table
from heartfit.protocol import curves_of_points
from heartfit.tables.sensitivity_figure import plot_sensitivities
from heartfit.tables.sensitivity_table import sensitivity_table
from heartfit.tables.surroundings_figure import plot_surroundings

record(snakemake.log[0])
files, out, given = snakemake.input, snakemake.output, snakemake.params
_, points = read_sigma_points(Path(files.points))
beats = map(read_beat, map(Path, files.beats))
found = read_sensitivity(Path(files.sensitivity))
title = f"{given.study.case}, {snakemake.wildcards.setting} setting"
curves = plot_surroundings(
    curves_of_points(given.setting, points, beats), found.parameters, title, given.study.step
)
list(map(write_figure, map(Path, out.curves), repeat(curves)))
list(map(write_figure, map(Path, out.figure), repeat(plot_sensitivities(found, title))))
list(map(write_table, map(Path, out.table), repeat(sensitivity_table(found, given.setting.units()))))

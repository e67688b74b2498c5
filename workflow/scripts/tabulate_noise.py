"""Tabulate the noise model and the coverage of its intervals on sequences that were not used for training."""

from itertools import repeat
from operator import attrgetter
from pathlib import Path

from heartfit.io.figures import write_figure
from heartfit.io.noise_models import read_comparison, read_noise_model, read_sensors
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.observation.noise_model import coverage, leave_one_out_coverage
from heartfit.results.noise_model import noise_model_table, plot_noise_model, sensor_table
from heartfit.results.text import render_table

record(snakemake.log[0])
files, out = snakemake.input, snakemake.output
model = read_noise_model(Path(files.model))
learnt = list(map(attrgetter("pair"), map(read_comparison, map(Path, files.learnt))))
fresh = list(map(attrgetter("pair"), map(read_comparison, map(Path, files.fresh))))
left_out = render_table(noise_model_table(model, leave_one_out_coverage(learnt, model.protocol)))
unseen = render_table(noise_model_table(model, coverage(model, fresh)))
sensors = render_table(sensor_table(read_sensors(Path(files.sensors))))
list(map(write_table, map(Path, out.left_out), repeat(left_out)))
list(map(write_table, map(Path, out.fresh), repeat(unseen)))
list(map(write_table, map(Path, out.sensors), repeat(sensors)))
list(map(write_figure, map(Path, out.figure), repeat(plot_noise_model(model, fresh))))

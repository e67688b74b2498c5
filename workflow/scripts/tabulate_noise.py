"""What the noise model knows, and how often it is right of sequences that it has not seen."""

from itertools import repeat
from operator import attrgetter
from pathlib import Path

from heartfit.io.comparisons import read_comparison
from heartfit.io.log import record
from heartfit.io.noise_models import read_noise_model, read_sensors
from heartfit.io.tables import write_figure, write_table
from heartfit.observation.coverage import coverage, coverage_of_left_out
from heartfit.tables.noise_model_figure import plot_noise_model
from heartfit.tables.noise_model_table import noise_model_table, sensor_table

record(snakemake.log[0])
files, out = snakemake.input, snakemake.output
model = read_noise_model(Path(files.model))
learnt = list(map(attrgetter("pair"), map(read_comparison, map(Path, files.learnt))))
fresh = list(map(attrgetter("pair"), map(read_comparison, map(Path, files.fresh))))
left_out = noise_model_table(model, coverage_of_left_out(learnt, model.protocol))
list(map(write_table, map(Path, out.left_out), repeat(left_out)))
list(map(write_table, map(Path, out.fresh), repeat(noise_model_table(model, coverage(model, fresh)))))
list(map(write_table, map(Path, out.sensors), repeat(sensor_table(read_sensors(Path(files.sensors))))))
list(map(write_figure, map(Path, out.figure), repeat(plot_noise_model(model, fresh))))

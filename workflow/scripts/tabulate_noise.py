"""Tabulate the noise model and the coverage of its intervals on sequences that were not used for training."""

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
learnt = [read_comparison(Path(file)).pair for file in files.learnt]
fresh = [read_comparison(Path(file)).pair for file in files.fresh]
left_out = render_table(noise_model_table(model, leave_one_out_coverage(learnt, model.protocol)))
unseen = render_table(noise_model_table(model, coverage(model, fresh)))
sensors = render_table(sensor_table(read_sensors(Path(files.sensors))))
for file in out.left_out:
    write_table(Path(file), left_out)
for file in out.fresh:
    write_table(Path(file), unseen)
for file in out.sensors:
    write_table(Path(file), sensors)
figure = plot_noise_model(model, fresh)
for file in out.figure:
    write_figure(Path(file), figure)

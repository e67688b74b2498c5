"""Compare the gains of a case's model by each tried mechanism."""

from pathlib import Path

from heartfit.io.figures import write_figure
from heartfit.io.refits import read_attempt
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.results.attempts import attempts_table, plot_attempts
from heartfit.results.text import render_table

record(snakemake.log[0])
files, names = snakemake.output, snakemake.wildcards
attempts = [read_attempt(Path(file)) for file in snakemake.input]
table = render_table(attempts_table(attempts))
for file in files.tables:
    write_table(Path(file), table)
figure = plot_attempts(attempts, f"{names.case}, {names.setting} setting")
for file in files.figure:
    write_figure(Path(file), figure)

"""Compare the gains of a case's model by each tried mechanism."""

from itertools import repeat
from pathlib import Path

from heartfit.io.figures import write_figure
from heartfit.io.refits import read_attempt
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.results.attempts import attempts_table, plot_attempts
from heartfit.results.text import render_table

record(snakemake.log[0])
files, names = snakemake.output, snakemake.wildcards
attempts = list(map(read_attempt, map(Path, snakemake.input)))
list(map(write_table, map(Path, files.tables), repeat(render_table(attempts_table(attempts)))))
figure = plot_attempts(attempts, f"{names.case}, {names.setting} setting")
list(map(write_figure, map(Path, files.figure), repeat(figure)))

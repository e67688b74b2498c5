"""Set beside each other what a case's model gains by each mechanism that was tried."""

from itertools import repeat
from pathlib import Path

from heartfit.io.attempts import read_attempt
from heartfit.io.log import record
from heartfit.io.tables import write_figure, write_table
from heartfit.tables.attempts_figure import plot_attempts
from heartfit.tables.attempts_table import attempts_table

record(snakemake.log[0])
files, names = snakemake.output, snakemake.wildcards
attempts = list(map(read_attempt, map(Path, snakemake.input)))
list(map(write_table, map(Path, files.tables), repeat(attempts_table(attempts))))
figure = plot_attempts(attempts, f"{names.case}, {names.setting} setting")
list(map(write_figure, map(Path, files.figure), repeat(figure)))

"""Compare named with planted mechanisms of each virtual case, and parameters with the truth."""

from itertools import repeat
from pathlib import Path

from heartfit.io.refits import read_proved
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.results.discovery import discovery_table
from heartfit.results.text import render_table

record(snakemake.log[0])
files, params = snakemake.input, snakemake.params
proved = list(
    map(read_proved, params.proved, files.causes, files.before, files.after, params.planted, files.truths)
)
list(map(write_table, map(Path, snakemake.output), repeat(render_table(discovery_table(proved)))))

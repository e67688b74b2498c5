"""Set what was named of each virtual case beside what was planted, and its parameters beside the truth."""

from itertools import repeat
from pathlib import Path

from heartfit.io.log import record
from heartfit.io.refits import read_proved
from heartfit.io.tables import write_table
from heartfit.tables.discovery_table import discovery_table

record(snakemake.log[0])
files, given = snakemake.input, snakemake.params
proved = list(
    map(read_proved, given.proved, files.causes, files.before, files.after, given.planted, files.truths)
)
list(map(write_table, map(Path, snakemake.output), repeat(discovery_table(proved))))

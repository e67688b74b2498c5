"""Extend a case's model by one mechanism, named or not, and compute its gain on held-out data."""

from pathlib import Path

from heartfit.io.refits import read_refit, read_trial, write_attempt
from heartfit.io.run import record

record(snakemake.log[0])
files, params = snakemake.input, snakemake.params
trial = read_trial(dict(files.items()), dict(params.items()))
attempt = trial.attempt(snakemake.wildcards.mechanism, read_refit(Path(files.refit)))
write_attempt(Path(snakemake.output[0]), attempt, params.code)

"""Extend a case's three-dimensional model by the named mechanisms and test it on held-out data."""

from pathlib import Path

from heartfit.io.causes import read_diagnosis, write_cause_card
from heartfit.io.refits import read_refit, read_trial, write_refit
from heartfit.io.run import record
from heartfit.results.cause_figure import render_cause

record(snakemake.log[0])
files, params, names = snakemake.input, snakemake.params, snakemake.wildcards
trial = read_trial(dict(files.items()), dict(params.items()))
diagnosis = read_diagnosis(Path(files.search).parent)
proved, extended = trial.prove(diagnosis, read_refit(Path(files.refit)))
card, *_, written = map(Path, snakemake.output)
write_cause_card(card.parent, render_cause(proved, f"{names.case}, {names.setting} setting"), params.code)
write_refit(written, extended, params.code)

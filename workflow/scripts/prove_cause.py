"""Extend a case's three-dimensional model by what the search names, and judge it by what was never fitted."""

from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.causes import write_cause_card
from heartfit.io.log import record
from heartfit.io.refits import read_refit, read_trial, write_refit
from heartfit.observation.beat import beat_curves
from heartfit.proof.centred_search import centred_search

record(snakemake.log[0])
files, given, names = snakemake.input, snakemake.params, snakemake.wildcards
trial = read_trial(dict(files.items()), dict(given.items()))
heart = given.setting.base_heart(given.case.period)
beats = list(map(beat_curves, map(read_beat, map(Path, files.beats))))
found = centred_search(trial.case.recording(), heart, beats)
proved, extended = trial.prove(found, read_refit(Path(files.refit)))
card, *_, written = map(Path, snakemake.output)
write_cause_card(card.parent, proved, f"{names.case}, {names.setting} setting", given.code)
write_refit(written, extended, given.code)

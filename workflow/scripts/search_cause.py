"""Search for a mechanism that a case's model lacks, on a sphere centred on its 3-D beat."""

from pathlib import Path

from heartfit.discovery.sphere_model.recentred import centred_search
from heartfit.io.beats import read_beat
from heartfit.io.causes import write_cause_card
from heartfit.io.refits import read_measured_case
from heartfit.io.run import record
from heartfit.observation.beat import beat_curves
from heartfit.results.cause_figure import render_cause

record(snakemake.log[0])
files, params, names = snakemake.input, snakemake.params, snakemake.wildcards
fitted, unseen = read_measured_case(dict(files.items()), reading=params.reading).halves()
heart, sensors = params.setting.base_heart(params.case.period), params.setting.sensors({})
beats = [beat_curves(read_beat(Path(file)), sensors) for file in files.beats]
outcome = centred_search(fitted, heart, beats, unseen)
title = f"{names.case}, {names.setting} setting: search on the sphere"
write_cause_card(Path(snakemake.output[0]).parent, render_cause(outcome, title), params.code)

"""Search on the sphere, centred on a case's own beat, for the cause of what its simulation gets wrong."""

from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.causes import write_cause_card
from heartfit.io.log import record
from heartfit.io.refits import read_measured_case
from heartfit.observation.beat import beat_curves
from heartfit.proof.centred_search import centred_search

record(snakemake.log[0])
files, given, names = snakemake.input, snakemake.params, snakemake.wildcards
recording = read_measured_case(files.measured, files.get("noise", [])).recording()
heart = given.setting.base_heart(given.case.period)
beats = list(map(beat_curves, map(read_beat, map(Path, files.beats))))
found = centred_search(recording, heart, beats)
folder, title = (
    Path(snakemake.output[0]).parent,
    f"{names.case}, {names.setting} setting: search on the sphere",
)
write_cause_card(folder, found, title, given.code)

"""Refit a case's baseline model to half of its samples by repeated unscented steps."""

from pathlib import Path

from heartfit.io.beats import write_beat
from heartfit.io.meshes import write_simulated_motion
from heartfit.io.refits import read_trial, write_refit
from heartfit.io.run import record

record(snakemake.log[0])
trial = read_trial(dict(snakemake.input.items()), dict(snakemake.params.items()))
code = snakemake.params.code
outcome = trial.refitted()
beat = trial.model(trial.baseline, outcome.parameters, keep_positions=True)
written, state, _, motion = map(Path, snakemake.output)
write_refit(written, outcome, code)
write_beat(state, beat, code)
write_simulated_motion(motion, beat, trial.registered.times)

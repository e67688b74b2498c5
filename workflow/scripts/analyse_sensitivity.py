"""Compute the effect and the plausible range of each parameter from the beats about the prior's mean."""

from pathlib import Path

from heartfit.calibration.plausible import plausible_ranges
from heartfit.calibration.sensitivity import sensitivity
from heartfit.io.beats import read_beat
from heartfit.io.noise_models import read_limits, write_ranges
from heartfit.io.results import read_sigma_points, write_sensitivity
from heartfit.io.run import record
from heartfit.personalise.run import OBSERVED, OBSERVED_RIGHT, observe_plausibility

record(snakemake.log[0])
params, out = snakemake.params, snakemake.output
prior, points = read_sigma_points(Path(snakemake.input.points))
beats = map(read_beat, map(Path, snakemake.input.beats))
outcomes = observe_plausibility(params.setting, points, beats, params.operator)
outcome = sensitivity(prior, points, outcomes, params.study.scaling(), OBSERVED)
right = sensitivity(prior, points, outcomes, params.study.scaling(), OBSERVED_RIGHT)
write_sensitivity(Path(out.sensitivity), outcome, params.code)
write_sensitivity(Path(out.right), right, params.code)
limits = read_limits(Path(snakemake.input.limits))
ranges = plausible_ranges(points, outcomes, limits, params.study.cap)
write_ranges(Path(out.ranges), ranges, params.code)

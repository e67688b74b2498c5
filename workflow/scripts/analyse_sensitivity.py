"""Find from the beats about the prior's mean what each parameter does, and how far it may go."""

from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.log import record
from heartfit.io.plausibility import read_limits, write_ranges
from heartfit.io.results import read_sigma_points, write_sensitivity
from heartfit.protocol import OBSERVED, observe_plausibility
from heartfit.sensitivity.covariance import sensitivity
from heartfit.sensitivity.plausible import plausible

record(snakemake.log[0])
given, out = snakemake.params, snakemake.output
prior, points = read_sigma_points(Path(snakemake.input.points))
beats = map(read_beat, map(Path, snakemake.input.beats))
outcomes = observe_plausibility(given.setting, points, beats, given.operator)
found = sensitivity(prior, points, outcomes, given.study.scaling(), OBSERVED)
write_sensitivity(Path(out.sensitivity), found, given.code)
limits = read_limits(Path(snakemake.input.limits))
ranges = plausible(points, outcomes, limits, given.study.cap)
write_ranges(Path(out.ranges), ranges, given.code)

"""Update the prior by what the sigma points' beats and the measurement show."""

from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.curves import read_curves
from heartfit.io.log import record
from heartfit.io.results import read_observations, read_sigma_points, write_posterior
from heartfit.protocol import estimate

record(snakemake.log[0])
prior, points = read_sigma_points(Path(snakemake.input.points))
measurement = read_observations(Path(snakemake.input.observations))
beats = map(read_beat, map(Path, snakemake.input.beats))
measured = read_curves(Path(snakemake.input.measured))
given = snakemake.params
arguments = (given.setting, prior, points, beats, measured, measurement)
posterior = estimate(*arguments, given.operator, given.transform)
write_posterior(Path(snakemake.output[0]), posterior, given.code)

"""Update the prior by what the sigma points' beats and the measurement show, as the paper and knowing the noise."""

from pathlib import Path

from heartfit.calibration.slopes import Slopes
from heartfit.io.beats import read_beat
from heartfit.io.curves import read_curves
from heartfit.io.log import record
from heartfit.io.results import read_observations, read_sensitivity, read_sigma_points, write_posterior
from heartfit.protocol import estimate

record(snakemake.log[0])
files, given = snakemake.input, snakemake.params
prior, points = read_sigma_points(Path(files.points))
measurement = read_observations(Path(files.observations))
beats = list(map(read_beat, map(Path, files.beats)))
arguments = (
    given.setting,
    prior,
    points,
    beats,
    read_curves(Path(files.measured)),
    measurement,
    given.operator,
)
seen = read_sensitivity(Path(files.sensitivity))
slopes = Slopes(seen.parameters, seen.observations, seen.slopes)
met, weighed = estimate(*arguments, given.transform), estimate(*arguments, given.transform.weighed(), slopes)
write_posterior(Path(snakemake.output.met), met, given.code)
write_posterior(Path(snakemake.output.weighed), weighed, given.code)

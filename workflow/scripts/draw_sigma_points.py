"""Draw the sigma points of a setting: about the prior's mean, or in a second iteration about the first estimate."""

from pathlib import Path

from heartfit.calibration.unscented import sigma_points
from heartfit.io.results import read_posterior, write_sigma_points
from heartfit.io.run import record
from heartfit.personalise.run import gaussian_of_points

record(snakemake.log[0])
first = [read_posterior(Path(file)) for file in snakemake.input]
around = gaussian_of_points(snakemake.params.setting, first)
points = sigma_points(around, snakemake.params.transform.scaling())
write_sigma_points(Path(snakemake.output[0]), around, points, snakemake.params.code)

"""Draw the sigma points of a setting's prior."""

from pathlib import Path

from heartfit.calibration.unscented import sigma_points
from heartfit.io.results import write_sigma_points
from heartfit.io.run import record

record(snakemake.log[0])
prior = snakemake.params.setting.gaussian()
points = sigma_points(prior, snakemake.params.transform.scaling())
write_sigma_points(Path(snakemake.output[0]), prior, points, snakemake.params.code)

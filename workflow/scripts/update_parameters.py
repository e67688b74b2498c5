"""Update the prior with the beats of the sigma points: noise-free as in the paper, and noise-aware."""

from pathlib import Path

from heartfit.calibration.sensitivity import Slopes
from heartfit.io.beats import read_beat
from heartfit.io.curves import read_curves
from heartfit.io.results import read_observations, read_sensitivity, read_sigma_points, write_posterior
from heartfit.io.run import record
from heartfit.personalise.run import estimate

record(snakemake.log[0])
files, params = snakemake.input, snakemake.params
around, points = read_sigma_points(Path(files.points))
measurement = read_observations(Path(files.observations))
beats = [read_beat(Path(file)) for file in files.beats]
measured = read_curves(Path(files.measured))
arguments = (params.setting, around, points, beats, measured, measurement, params.operator)
slopes = Slopes.from_parts([read_sensitivity(Path(file)) for file in files.sensitivities])
noise_free, noise_aware = (
    estimate(*arguments, params.transform),
    estimate(*arguments, params.transform.with_noise(), slopes),
)
write_posterior(Path(snakemake.output.noise_free), noise_free, params.code)
write_posterior(Path(snakemake.output.noise_aware), noise_aware, params.code)

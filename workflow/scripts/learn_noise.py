"""Learn the noise of curves and observations from registered sequences of known truth."""

from operator import attrgetter
from pathlib import Path

from heartfit.io.noise_models import read_comparison, write_noise_model, write_sensors
from heartfit.io.run import record
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.scatter import sensor_scatter

record(snakemake.log[0])
pairs = list(map(attrgetter("pair"), map(read_comparison, map(Path, snakemake.input))))
model = NoiseModel.from_pairs(pairs, snakemake.params.protocol)
write_noise_model(Path(snakemake.output.model), model, snakemake.params.code)
write_sensors(Path(snakemake.output.sensors), sensor_scatter(pairs), snakemake.params.code)

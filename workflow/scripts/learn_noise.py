"""Learn from registered sequences of known truth what the measurement does to curves and observations."""

from operator import attrgetter
from pathlib import Path

from heartfit.io.comparisons import read_comparison
from heartfit.io.log import record
from heartfit.io.noise_models import write_noise_model, write_sensors
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.sensor_scatter import sensor_scatter

record(snakemake.log[0])
pairs = list(map(attrgetter("pair"), map(read_comparison, map(Path, snakemake.input))))
model = NoiseModel.of(pairs, snakemake.params.protocol)
write_noise_model(Path(snakemake.output.model), model, snakemake.params.code)
write_sensors(Path(snakemake.output.sensors), sensor_scatter(pairs), snakemake.params.code)

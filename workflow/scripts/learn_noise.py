"""Learn the noise of curves and observations from registered sequences of known truth."""

from pathlib import Path

from heartfit.io.noise_models import read_comparison, write_noise_model, write_sensors
from heartfit.io.run import record
from heartfit.observation.comparison import learn_noise
from heartfit.observation.scatter import sensor_scatter

record(snakemake.log[0])
comparisons = [read_comparison(Path(file)) for file in snakemake.input]
model = learn_noise(comparisons, snakemake.params.protocol)
write_noise_model(Path(snakemake.output.model), model, snakemake.params.code)
sensors = sensor_scatter([comparison.pair for comparison in comparisons])
write_sensors(Path(snakemake.output.sensors), sensors, snakemake.params.code)

"""Extract volume curves of both cavities from the registered mesh, and observe them and the recorded pressure."""

from pathlib import Path

from heartfit.io.curves import read_curves, write_curves
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.noise_models import read_noise_model
from heartfit.io.results import write_observations
from heartfit.io.run import record
from heartfit.observation.shape import cavity_volumes
from heartfit.personalise.run import observe_case

record(snakemake.log[0])
files, params = snakemake.input, snakemake.params
curves = cavity_volumes(read_mesh(Path(files.mesh)), read_motion(Path(files.motion)))
for file in files.get("pressure", []):
    curves |= read_curves(Path(file))
models = [read_noise_model(Path(file)) for file in files.get("noise", [])]
measurement = observe_case(curves, params.operator, models, params.protocol, params.also)
write_curves(Path(snakemake.output.curves), curves)
write_observations(Path(snakemake.output.observations), measurement, params.code)

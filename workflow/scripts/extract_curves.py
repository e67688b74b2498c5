"""Volume curves of both cavities from the registered mesh, and what is observed of them."""

from pathlib import Path

from heartfit.io.curves import write_curves
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.noise_models import read_noise_model
from heartfit.io.results import write_observations
from heartfit.observation.volumes import cavity_volumes
from heartfit.protocol import observe_case

record(snakemake.log[0])
files, given = snakemake.input, snakemake.params
curves = cavity_volumes(read_mesh(Path(files.mesh)), read_motion(Path(files.motion)))
models = list(map(read_noise_model, map(Path, files.get("noise", []))))
measurement = observe_case(curves, given.operator, models, given.protocol)
write_curves(Path(snakemake.output.curves), curves)
write_observations(Path(snakemake.output.observations), measurement, given.code)

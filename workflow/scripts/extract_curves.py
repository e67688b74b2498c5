"""Volume curves of both cavities from the registered mesh, and what is observed of them."""

from pathlib import Path

from heartfit.io.curves import write_curves
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.results import write_observations
from heartfit.observation.measurement import observe_measured
from heartfit.observation.volumes import cavity_volumes

record(snakemake.log[0])
mesh = read_mesh(Path(snakemake.input.mesh))
curves = cavity_volumes(mesh, read_motion(Path(snakemake.input.motion)))
operator = snakemake.params.operator
measurement = observe_measured(curves, operator.features(curves), operator.period_uncertainty)
write_curves(Path(snakemake.output.curves), curves)
write_observations(Path(snakemake.output.observations), measurement, snakemake.params.code)

"""Compute Sobol's indices for the reference volunteer's left ventricle as a sphere."""

from pathlib import Path

from heartfit.calibration.sobol import sobol_indices
from heartfit.io.meshes import read_mesh
from heartfit.io.noise_models import write_sobol
from heartfit.io.run import record
from heartfit.synthetic.known_hearts import SphericalCase

record(snakemake.log[0])
params = snakemake.params
mesh = read_mesh(Path(snakemake.input.mesh))
heart = params.setting.base_heart(params.case.period)
features = params.operator.trial_features(params.operator.frames)
case = SphericalCase.of(mesh, params.pressures.lv, heart, features, params.scheme.numerics())
indices = sobol_indices(params.setting.gaussian(), case, params.sphere.samples, params.sphere.seed)
write_sobol(Path(snakemake.output[0]), indices, params.code)

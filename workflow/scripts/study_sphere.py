"""Sobol's indices of the reference volunteer's left ventricle as a sphere."""

from pathlib import Path

from heartfit.io.log import record
from heartfit.io.meshes import read_mesh
from heartfit.io.plausibility import write_sobol
from heartfit.sensitivity.sobol import sobol_indices
from heartfit.spherical_case import SphericalCase

record(snakemake.log[0])
given = snakemake.params
mesh = read_mesh(Path(snakemake.input.mesh))
heart = given.setting.base_heart(given.case.period)
features = given.operator.trial_features(given.operator.frames)
case = SphericalCase.of(mesh, given.pressures.lv, heart, features, given.scheme.numerics())
indices = sobol_indices(given.setting.gaussian(), case, given.sphere.samples, given.sphere.seed)
write_sobol(Path(snakemake.output[0]), indices, given.code)

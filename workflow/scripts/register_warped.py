"""Carry the simulated mesh through warped images, and compare its motion with the simulated one."""

from pathlib import Path

from heartfit.io.images import read_images
from heartfit.io.meshes import read_mesh, read_motion, write_motion
from heartfit.io.noise_models import write_comparison
from heartfit.io.run import record
from heartfit.synthetic.warp import register_warped

record(snakemake.log[0])
files, params = snakemake.input, snakemake.params
mesh, motion = read_mesh(Path(files.mesh)), read_motion(Path(files.motion))
images = read_images(Path(files.images))
features = {"lv_volume": params.operator.trial_features(len(images.times))["lv_volume"]}
registered, comparison = register_warped(images, mesh, motion, params.registration, features)
write_motion(Path(snakemake.output.motion), registered)
write_comparison(Path(snakemake.output.comparison), comparison, params.code)

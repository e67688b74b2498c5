"""Image the beat of a virtual volunteer, as a scanner would."""

from pathlib import Path

from heartfit.io.images import write_images
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.run import record
from heartfit.synthetic.cine import image_beat

record(snakemake.log[0])
mesh = read_mesh(Path(snakemake.input.mesh))
motion = read_motion(Path(snakemake.input.motion))
images = image_beat(mesh, motion, snakemake.params.scanner, snakemake.params.case.seed)
write_images(Path(snakemake.output.images), images)

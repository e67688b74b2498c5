"""Carry the mesh of a segmented heart through its cine, or through its segmentations if every frame has one."""

from pathlib import Path

from heartfit.imaging.checks import require_match
from heartfit.imaging.registration.track import track
from heartfit.io.images import read_images
from heartfit.io.meshes import read_mesh, write_motion
from heartfit.io.results import write_result
from heartfit.io.run import record
from heartfit.io.segmentations import sequence_to_track
from heartfit.io.sources import IMAGE_MARGIN

record(snakemake.log[0])
mesh = read_mesh(Path(snakemake.input.mesh))
images = read_images(Path(snakemake.input.images))
require_match(images, mesh, IMAGE_MARGIN)
params = snakemake.params
tracking = track(sequence_to_track(params.source, images), mesh, params.registration)
write_motion(Path(snakemake.output.motion), tracking.motion)
units = {"mismatch": "1", "compression": "1", "unfolded": "nodes"}
quality = {"mismatch": tracking.mismatch, "compression": tracking.compression, "unfolded": tracking.unfolded}
write_result(Path(snakemake.output.quality), quality, params.code, units)

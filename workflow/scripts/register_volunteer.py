"""Carry the mesh of a volunteer through the volunteer's images."""

from pathlib import Path

from heartfit.imaging.checks import require_match
from heartfit.imaging.registration.track import track
from heartfit.io.images import read_images
from heartfit.io.meshes import read_mesh, write_motion
from heartfit.io.results import write_result
from heartfit.io.run import record

record(snakemake.log[0])
mesh = read_mesh(Path(snakemake.input.mesh))
images = read_images(Path(snakemake.input.images)).starting_at(snakemake.params.end_diastole)
require_match(images, mesh)
tracking = track(images, mesh, snakemake.params.registration)
write_motion(Path(snakemake.output.motion), tracking.motion)
units = {"mismatch": "1", "compression": "1", "unfolded": "nodes"}
quality = {"mismatch": tracking.mismatch, "compression": tracking.compression, "unfolded": tracking.unfolded}
write_result(Path(snakemake.output.quality), quality, snakemake.params.code, units)

"""Register the short-axis images of the measured heart slice by slice on their first frame."""

from pathlib import Path

from heartfit.imaging.registration.slices import register_slices, require_unfolded
from heartfit.io.images import read_images
from heartfit.io.run import record
from heartfit.io.slice_motions import write_slice_motion
from heartfit.io.sources import read_heart

record(snakemake.log[0])
heart = read_heart(snakemake.params.source)
images = read_images(Path(snakemake.input.images), heart.period, heart.times)
motion = register_slices(images, heart.surface.points)
require_unfolded(motion)
write_slice_motion(Path(snakemake.output[0]), motion)

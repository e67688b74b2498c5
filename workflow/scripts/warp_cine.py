"""Move the real short-axis images of the measured heart as its simulation does, or image a phantom."""

from pathlib import Path

from heartfit.io.images import read_images, write_images
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.run import record
from heartfit.io.slice_motions import read_slice_motion
from heartfit.synthetic.warp import moving_images, scanner_like

record(snakemake.log[0])
files, params = snakemake.input, snakemake.params
mesh, motion = read_mesh(Path(files.mesh)), read_motion(Path(files.motion))
images = read_images(Path(files.images), motion.period, motion.times)
slices = read_slice_motion(Path(files.slices))
scanner = scanner_like(images, params.thickness, params.scanner)
warped = moving_images(snakemake.wildcards.content, images, slices, mesh, motion, scanner)
write_images(Path(snakemake.output.images), warped)

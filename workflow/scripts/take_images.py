"""Read the images of a measured heart and write them from end diastole, with the times of their frames."""

from pathlib import Path

from heartfit.io.images import write_images
from heartfit.io.run import record
from heartfit.io.sources import read_source_images

record(snakemake.log[0])
params = snakemake.params
write_images(Path(snakemake.output.images), read_source_images(params.case, params.source))

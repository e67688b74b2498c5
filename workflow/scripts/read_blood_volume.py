"""Read the left ventricular volume from the blood of real short-axis images, and that of the measured surface."""

from pathlib import Path

from heartfit.io.curves import read_curves, write_curves
from heartfit.io.images import read_images
from heartfit.io.run import record
from heartfit.io.sources import read_heart
from heartfit.observation.blood_area import MeasuredWall, read_blood_volume

record(snakemake.log[0])
files = snakemake.input
heart = read_heart(snakemake.params.source)
images = read_images(Path(files.images), heart.period, heart.times)
volume = read_curves(Path(files.measured))["lv_volume"]
blood = read_blood_volume(images, MeasuredWall(heart.surface, heart.positions), volume)
write_curves(Path(snakemake.output[0]), {"lv_volume": blood})

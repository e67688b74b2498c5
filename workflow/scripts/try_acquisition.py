"""Image a volunteer, register the images and compare what was found with what was simulated."""

from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.comparisons import write_comparison
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.observation.trial import try_acquisition

record(snakemake.log[0])
files, given = snakemake.input, snakemake.params
mesh, motion = read_mesh(Path(files.mesh)), read_motion(Path(files.motion))
measurement = (given.scanner, given.registration, given.catheter)
features = given.operator.trial_features(given.scanner.frames)
seed = int(snakemake.wildcards.number)
comparison = try_acquisition(mesh, motion, read_beat(Path(files.beat)), *measurement, features, seed)
write_comparison(Path(snakemake.output[0]), comparison, given.code)

"""Image a volunteer, register the images and compare the registered with the simulated motion."""

from pathlib import Path

from heartfit.io.beats import read_beat
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.noise_models import write_comparison
from heartfit.io.run import record
from heartfit.synthetic.cine import try_acquisition

record(snakemake.log[0])
files, params = snakemake.input, snakemake.params
mesh, motion = read_mesh(Path(files.mesh)), read_motion(Path(files.motion))
measurement = (params.scanner, params.registration, params.catheter)
features = params.operator.trial_features(params.scanner.frames)
seed = int(snakemake.wildcards.number)
comparison = try_acquisition(mesh, motion, read_beat(Path(files.beat)), *measurement, features, seed)
write_comparison(Path(snakemake.output[0]), comparison, params.code)

"""Show what a case's calibrated simulation leaves of every measured curve, and of the strain of each segment."""

from itertools import repeat
from pathlib import Path

from heartfit.io.comparisons import read_comparison
from heartfit.io.curves import read_curves
from heartfit.io.log import record
from heartfit.io.meshes import read_mesh, read_motion
from heartfit.io.noise_models import read_noise_model
from heartfit.io.seen import read_seen
from heartfit.io.simulated_motion import read_simulated_motion
from heartfit.io.tables import write_figure, write_table
from heartfit.observation.residual import case_residual
from heartfit.observation.strain_residual import strain_residual
from heartfit.tables.residual_figure import LABELS, plot_residual
from heartfit.tables.residual_table import residual_table

record(snakemake.log[0])
files, names = snakemake.input, snakemake.wildcards
seen = map(read_seen, files.beats, files.fitted, repeat(snakemake.params.setting))
models = list(map(read_noise_model, map(Path, files.get("noise", []))))
known = list(map(read_comparison, map(Path, files.get("known", []))))
registered, simulated = read_motion(Path(files.registered)), read_simulated_motion(Path(files.motions[-1]))
strain = strain_residual(read_mesh(Path(files.mesh)), registered, simulated, known)
beats = dict(zip(LABELS, seen, strict=False))
residual = case_residual(read_curves(Path(files.measured)), beats, models, strain)
write_table(Path(snakemake.output.table), residual_table(residual))
figure = plot_residual(residual, f"{names.case}, {names.setting} setting")
list(map(write_figure, map(Path, snakemake.output.figure), repeat(figure)))

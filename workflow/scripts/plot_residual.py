"""Plot the residual of a case's calibrated simulation for each measured curve and the strain of each segment."""

from pathlib import Path

from heartfit.io.beats import read_fitted_curves
from heartfit.io.curves import read_curves
from heartfit.io.figures import write_figure
from heartfit.io.meshes import read_mesh, read_motion, read_simulated_motion
from heartfit.io.noise_models import read_noise_model
from heartfit.io.run import record
from heartfit.io.tables import write_csv
from heartfit.observation.residual import case_residual, strain_residual
from heartfit.results.residual import LABELS, plot_residual, residual_table

record(snakemake.log[0])
files, names = snakemake.input, snakemake.wildcards
models = [read_noise_model(Path(file)) for file in files.get("noise", [])]
registered, simulated = read_motion(Path(files.registered)), read_simulated_motion(Path(files.motions[-1]))
strain = strain_residual(read_mesh(Path(files.mesh)), registered, simulated, models)
beats = {
    label: read_fitted_curves(beat, fitted, snakemake.params.setting)
    for label, beat, fitted in zip(LABELS, files.beats, files.fitted, strict=False)
}
residual = case_residual(read_curves(Path(files.measured)), beats, models, strain)
write_csv(Path(snakemake.output.table), residual_table(residual))
figure = plot_residual(residual, f"{names.case}, {names.setting} setting", snakemake.params.colour)
for file in snakemake.output.figure:
    write_figure(Path(file), figure)

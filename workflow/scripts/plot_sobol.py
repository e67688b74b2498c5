"""Plot and tabulate Sobol's indices of the sphere, with the covariances of the mesh."""

from itertools import repeat
from pathlib import Path

from heartfit.io.figures import write_figure
from heartfit.io.noise_models import read_sobol
from heartfit.io.results import read_sensitivity
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.results.sensitivity import plot_sobol, sobol_table
from heartfit.results.text import render_table

record(snakemake.log[0])
files, out = snakemake.input, snakemake.output
settings = snakemake.params.settings
outcome = dict(zip(settings, map(read_sensitivity, map(Path, files.sensitivities)), strict=True))
sobol = read_sobol(Path(files.sobol))
list(map(write_table, map(Path, out.table), repeat(render_table(sobol_table(sobol)))))
list(map(write_figure, map(Path, out.figure), repeat(plot_sobol(sobol, outcome, snakemake.params.colours))))

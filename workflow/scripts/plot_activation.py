"""Draw the activation times of the ventricles."""

from pathlib import Path

from heartfit.io.figures import write_figure
from heartfit.io.meshes import read_mesh
from heartfit.io.run import record
from heartfit.results.activation import plot_activation

record(snakemake.log[0])
case = snakemake.params.case
figure = plot_activation(read_mesh(Path(snakemake.input[0])), case.conduction, case.case)
for file in snakemake.output:
    write_figure(Path(file), figure)

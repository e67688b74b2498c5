"""Plot the sensitivity of the observations to the parameters."""

from itertools import repeat
from pathlib import Path

from heartfit.io.results import read_posterior
from heartfit.io.run import record
from heartfit.io.tables import write_figure
from heartfit.results.figures import plot_sensitivity

record(snakemake.log[0])
title = "{case}, {setting} setting".format(**dict(snakemake.wildcards.items()))
figure = plot_sensitivity(read_posterior(Path(snakemake.input[0])), title)
list(map(write_figure, map(Path, snakemake.output), repeat(figure)))

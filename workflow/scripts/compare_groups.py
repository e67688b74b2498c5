"""Whether the patients differ from the volunteers, and whether the paper's claims of them hold."""

from pathlib import Path

from heartfit.io.log import record
from heartfit.io.results import read_posterior, read_truth
from heartfit.io.tables import write_figures, write_tables
from heartfit.tables.card import cards
from heartfit.tables.specificity import comparisons
from heartfit.tables.specificity_figure import plot_specificity
from heartfit.tables.specificity_table import claims_table, specificity_table

record(snakemake.log[0])
files, given = snakemake.input, snakemake.params
truths = dict(zip(given.groups.virtual, map(read_truth, map(Path, files.truths)), strict=True))
met, weighed = map(read_posterior, map(Path, files.met)), map(read_posterior, map(Path, files.weighed))
compared = comparisons(cards(given.calibrated, met, weighed, truths), given.groups)
folder = Path(given.results)
write_tables(
    folder / "tables", {"specificity": specificity_table(compared), "claims": claims_table(compared)}
)
write_figures(folder / "figures", {"specificity": plot_specificity(compared)})

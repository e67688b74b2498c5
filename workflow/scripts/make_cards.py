"""What the data say of each parameter of each case: cards, their table, and how often intervals hold the truth."""

from pathlib import Path

from heartfit.io.log import record
from heartfit.io.results import read_posterior, read_truth
from heartfit.io.tables import write_figures, write_tables
from heartfit.tables.card import cards
from heartfit.tables.card_figure import plot_cards
from heartfit.tables.cards_table import cards_table, coverage_table

record(snakemake.log[0])
files, given = snakemake.input, snakemake.params
truths = dict(zip(given.groups.virtual, map(read_truth, map(Path, files.truths)), strict=True))
met, weighed = map(read_posterior, map(Path, files.met)), map(read_posterior, map(Path, files.weighed))
made = cards(given.calibrated, met, weighed, truths)
folder = Path(given.results)
write_tables(folder / "tables", {"cards": cards_table(made), "coverage_cohort": coverage_table(made)})
write_figures(folder / "figures", plot_cards(made))

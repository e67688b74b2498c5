"""Write the information of the data on each parameter of each case: cards, their table, and the coverage of
intervals.
"""

from pathlib import Path

from heartfit.io.figures import write_figures
from heartfit.io.results import read_posterior, read_truth
from heartfit.io.run import record
from heartfit.io.tables import write_tables
from heartfit.results.card import cards, cards_table, coverage_table
from heartfit.results.card_figure import plot_cards
from heartfit.results.text import render_tables

record(snakemake.log[0])
files, params = snakemake.input, snakemake.params
truths = {
    name: read_truth(Path(file)) for name, file in zip(params.groups.virtual, files.truths, strict=True)
}
noise_free = map(read_posterior, map(Path, files.noise_free))
noise_aware = map(read_posterior, map(Path, files.noise_aware))
case_cards = cards(params.calibrated, noise_free, noise_aware, truths)
folder = Path(params.results)
tables = {"cards": cards_table(case_cards), "coverage_cohort": coverage_table(case_cards)}
write_tables(folder / "tables", render_tables(tables))
write_figures(snakemake.output.figures, plot_cards(case_cards, params.colours))

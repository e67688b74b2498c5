"""Open the answers and score what was said of every planted case: tables, figures and the page of the docs."""

from pathlib import Path

from heartfit.io.atomic import write_text
from heartfit.io.log import record
from heartfit.io.results import read_fingerprint
from heartfit.io.scores import read_scored
from heartfit.io.tables import write_figure, write_tables
from heartfit.tables.planted_by_data import by_data_table
from heartfit.tables.planted_figures import plot_confusion, plot_power, plot_rates
from heartfit.tables.planted_page import planted_page
from heartfit.tables.planted_table import cases_table, mechanisms_table, rates_table

record(snakemake.log[0])
out = snakemake.output
scored = read_scored(snakemake.input.findings, snakemake.input.sealed)
tables = {
    "rates": rates_table(scored),
    "mechanisms": mechanisms_table(scored),
    "data": by_data_table(scored),
    "cases": cases_table(scored),
}
write_tables(Path(out.tables[0]).parent, tables)
code = read_fingerprint(Path(snakemake.input.findings[0]))
write_text(Path(out.page), planted_page(scored, snakemake.params.planned, code))
figures = plot_rates(scored), plot_confusion(scored), plot_power(scored)
list(map(write_figure, map(Path, out.figures), figures))

"""Open the answers and score what was said of effects hidden in three dimensions: tables, figure and page."""

from pathlib import Path

from heartfit.discovery.rules import CENTRED
from heartfit.io.atomic import write_text
from heartfit.io.log import record
from heartfit.io.scores import read_scored
from heartfit.io.tables import write_figure, write_tables
from heartfit.planting.least import Least
from heartfit.tables.planted_table import cases_table, mechanisms_table
from heartfit.tables.planted_ventricles import ventricles_page, ventricles_rates
from heartfit.tables.planted_ventricles_figure import plot_ventricles

record(snakemake.log[0])
out = snakemake.output
scored = read_scored(snakemake.input.findings, snakemake.input.sealed)
least = Least.of(scored, CENTRED.detected)
rates = ventricles_rates(scored, least)
tables = {"rates": rates, "mechanisms": mechanisms_table(scored), "cases": cases_table(scored)}
write_tables(Path(out.tables[0]).parent, tables)
write_text(Path(out.page), ventricles_page(scored, snakemake.params.planned, least))
write_figure(Path(out.figure), plot_ventricles(scored))

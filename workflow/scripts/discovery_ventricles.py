"""Score the diagnoses of effects hidden in 3-D with the unsealed answers: tables, figure and page."""

from pathlib import Path

from heartfit.discovery.inference.decide import CENTRED_RULES
from heartfit.io.figures import write_figure
from heartfit.io.files import write_text
from heartfit.io.run import record
from heartfit.io.scores import read_scored
from heartfit.io.tables import write_tables
from heartfit.results.planted_figures import plot_ventricles
from heartfit.results.planted_page import ventricles_page, ventricles_rates
from heartfit.results.planted_table import cases_table, mechanisms_table
from heartfit.results.text import render_tables
from heartfit.synthetic.scoring import DetectableSizes

record(snakemake.log[0])
out = snakemake.output
scored = read_scored(snakemake.input.findings, snakemake.input.sealed)
least = DetectableSizes.of(scored, CENTRED_RULES.detected)
rates = ventricles_rates(scored, least)
tables = {"rates": rates, "mechanisms": mechanisms_table(scored), "cases": cases_table(scored)}
write_tables(Path(out.tables[0]).parent, render_tables(tables))
write_text(Path(out.page), ventricles_page(scored, snakemake.params.planned, least))
write_figure(Path(out.figure), plot_ventricles(scored))

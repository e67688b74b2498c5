"""Score the diagnoses of all planted cases with the unsealed answers: tables, figures and the page."""

from pathlib import Path

from heartfit.discovery.inference.decide import DEFAULT_RULES
from heartfit.io.figures import write_figure
from heartfit.io.files import write_text
from heartfit.io.results import read_fingerprint
from heartfit.io.run import record
from heartfit.io.scores import read_scored
from heartfit.io.tables import write_tables
from heartfit.results.planted_figures import plot_confusion, plot_power, plot_rates
from heartfit.results.planted_page import planted_page, planted_tables
from heartfit.results.text import render_tables
from heartfit.synthetic.scoring import DetectableSizes, of_population

record(snakemake.log[0])
out = snakemake.output
scored = read_scored(snakemake.input.findings, snakemake.input.sealed)
least = DetectableSizes.of(scored, DEFAULT_RULES.detected)
write_tables(Path(out.tables[0]).parent, render_tables(planted_tables(scored, least)))
code = read_fingerprint(Path(snakemake.input.findings[0]))
write_text(Path(out.page), planted_page(scored, snakemake.params.planned, code, least))
cases = of_population(scored, "as searched")
figures = plot_rates(cases, least.rates()), plot_confusion(cases), plot_power(cases)
list(map(write_figure, map(Path, out.figures), figures))

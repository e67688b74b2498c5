"""Score the diagnoses of all planted cases with the unsealed answers: tables and figures."""

from pathlib import Path

from heartfit.discovery.inference.decide import DEFAULT_RULES
from heartfit.io.figures import write_figure
from heartfit.io.run import record
from heartfit.io.scores import read_scored
from heartfit.io.tables import write_measured_tables, write_tables
from heartfit.results.planted_figures import plot_confusion, plot_power, plot_rates
from heartfit.results.planted_summary import planted_tables
from heartfit.results.text import printed_tables, render_tables
from heartfit.synthetic.scoring import DetectableSizes, of_population

record(snakemake.log[0])
out = snakemake.output
scored = read_scored(snakemake.input.findings, snakemake.input.sealed)
least = DetectableSizes.of(scored, DEFAULT_RULES.detected)
tables = planted_tables(scored, least, snakemake.params.planned)
write_tables(Path(out.tables[0]).parent, render_tables(tables))
write_measured_tables(out.stored, "planted", printed_tables(tables), "snakemake discovery_benchmark")
cases = of_population(scored, "as searched")
figures = plot_rates(cases, least.rates()), plot_confusion(cases), plot_power(cases)
for file, figure in zip(out.figures, figures, strict=True):
    write_figure(Path(file), figure)

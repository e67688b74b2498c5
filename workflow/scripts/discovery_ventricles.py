"""Score the diagnoses of effects hidden in 3-D with the unsealed answers: tables and figure."""

from pathlib import Path

from heartfit.discovery.inference.decide import CENTRED_RULES
from heartfit.io.figures import write_figure
from heartfit.io.run import record
from heartfit.io.scores import read_scored
from heartfit.io.tables import write_measured_tables, write_tables
from heartfit.results.planted_figures import plot_ventricles
from heartfit.results.planted_summary import ventricles_tables
from heartfit.results.text import printed_tables, render_tables
from heartfit.synthetic.scoring import DetectableSizes

record(snakemake.log[0])
out = snakemake.output
scored = read_scored(snakemake.input.findings, snakemake.input.sealed)
least = DetectableSizes.of(scored, CENTRED_RULES.detected)
tables = ventricles_tables(scored, least, snakemake.params.planned)
write_tables(Path(out.tables[0]).parent, render_tables(tables))
write_measured_tables(out.stored, "planted_3d", printed_tables(tables), "snakemake discovery_ventricles")
write_figure(Path(out.figure), plot_ventricles(scored))

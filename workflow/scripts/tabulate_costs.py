"""Tabulate and plot time and memory of every job, by stage."""

from pathlib import Path

from heartfit.io.campaign import read_benchmarks
from heartfit.io.figures import write_figures
from heartfit.io.run import record
from heartfit.io.tables import write_tables
from heartfit.results.costs import cost_table, plot_costs
from heartfit.results.text import render_tables

record(snakemake.log[0])
folder = Path(snakemake.params.results)
table = cost_table(read_benchmarks(folder / "benchmarks"))
write_tables(folder / "tables", render_tables({"costs": table}))
write_figures(snakemake.output.figure, {"costs": plot_costs(table)})

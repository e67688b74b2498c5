"""Test the difference between patients and volunteers, and the paper's claims about them."""

from pathlib import Path

from heartfit.io.figures import write_figures
from heartfit.io.results import read_posterior, read_truth
from heartfit.io.run import record
from heartfit.io.tables import read_published, write_tables
from heartfit.results.card import cards
from heartfit.results.claims import claimed_limits
from heartfit.results.specificity import compare_groups
from heartfit.results.specificity_table import plot_specificity, specificity_claims, specificity_table
from heartfit.results.text import render_tables

record(snakemake.log[0])
files, params = snakemake.input, snakemake.params
truths = {
    name: read_truth(Path(file)) for name, file in zip(params.groups.virtual, files.truths, strict=True)
}
noise_free = map(read_posterior, map(Path, files.noise_free))
noise_aware = map(read_posterior, map(Path, files.noise_aware))
compared = compare_groups(cards(params.calibrated, noise_free, noise_aware, truths), params.groups)
folder, limits = Path(params.results), claimed_limits(read_published(Path(files.claims)))
tables = {
    "specificity": specificity_table(compared),
    "specificity_claims": specificity_claims(compared, limits),
}
write_tables(folder / "tables", render_tables(tables))
write_figures(snakemake.output.figure, {"specificity": plot_specificity(compared, limits)})

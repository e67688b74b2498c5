"""Tabulate the selected parameters, the prior of the rule, and the effect of the bulk modulus."""

from pathlib import Path

from heartfit.io.noise_models import read_ranges
from heartfit.io.results import read_sensitivity
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.results.parameters import prior_table
from heartfit.results.sensitivity import bulk_modulus_table, selection_table
from heartfit.results.text import render_table

record(snakemake.log[0])
files, out, params = snakemake.input, snakemake.output, snakemake.params
outcome = {
    name: read_sensitivity(Path(file))
    for name, file in zip(params.settings, files.sensitivities, strict=True)
}
ranges = {name: read_ranges(Path(file)) for name, file in zip(params.settings, files.ranges, strict=True)}
selection = render_table(selection_table(outcome, ranges, params.estimated))
for file in out.selection:
    write_table(Path(file), selection)
prior = render_table(prior_table(ranges, outcome, params.units))
for file in out.prior:
    write_table(Path(file), prior)
bulk_modulus = render_table(bulk_modulus_table(outcome, params.units))
for file in out.bulk_modulus:
    write_table(Path(file), bulk_modulus)

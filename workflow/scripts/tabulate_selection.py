"""Tabulate the selected parameters, the prior of the rule, and the effect of the bulk modulus."""

from itertools import repeat
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
outcome = dict(zip(params.settings, map(read_sensitivity, map(Path, files.sensitivities)), strict=True))
ranges = dict(zip(params.settings, map(read_ranges, map(Path, files.ranges)), strict=True))
selection = selection_table(outcome, ranges, params.estimated)
list(map(write_table, map(Path, out.selection), repeat(render_table(selection))))
list(map(write_table, map(Path, out.prior), repeat(render_table(prior_table(ranges, outcome, params.units)))))
bulk_modulus = bulk_modulus_table(outcome, params.units)
list(map(write_table, map(Path, out.bulk_modulus), repeat(render_table(bulk_modulus))))

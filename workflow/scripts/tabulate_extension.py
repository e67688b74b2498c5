"""Tabulate and draw a measured case without and with the mechanisms that were named."""

from pathlib import Path

from heartfit.io.causes import read_diagnosis
from heartfit.io.figures import write_figure
from heartfit.io.refits import read_left_volume
from heartfit.io.run import record
from heartfit.io.tables import write_table
from heartfit.results.extension import extension_table, plot_extension
from heartfit.results.text import render_table

record(snakemake.log[0])
files, output, names = snakemake.input, snakemake.output, snakemake.wildcards
diagnosis = read_diagnosis(Path(files.cause).parent)
readings = [read_left_volume(file) for file in (files.measured, *files.get("second", []))]
table = render_table(extension_table(diagnosis, readings))
for file in output.tables:
    write_table(Path(file), table)
figure = plot_extension(diagnosis, f"{names.case}, {names.setting} setting")
for file in output.figure:
    write_figure(Path(file), figure)

"""Beliefs, observations and curves of every case as InferenceData and as tidy tables, for other programs."""

from functools import partial
from itertools import starmap
from pathlib import Path

from heartfit.exchange.tidy import curves_table, parameters_table
from heartfit.io.exchange import read_calibrated, write_every_inference_data
from heartfit.io.log import record
from heartfit.io.tables import write_table

record(snakemake.log[0])
given, folder = snakemake.params, Path(snakemake.params.results)
found = list(starmap(partial(read_calibrated, folder), given.calibrated))
write_every_inference_data(folder, found)
write_table(folder / "tables" / "posteriors.csv", parameters_table(found))
write_table(folder / "tables" / "curves.csv", curves_table(found))

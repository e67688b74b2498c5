"""Write posteriors, observations and curves of every case as InferenceData and as tidy tables."""

from pathlib import Path

from heartfit.io.exchange import read_calibrated, write_every_inference_data
from heartfit.io.run import record
from heartfit.io.tables import write_csv
from heartfit.results.exchange import curves_table, inference_groups, parameters_table

record(snakemake.log[0])
params, folder = snakemake.params, Path(snakemake.params.results)
outcome = [read_calibrated(folder, case, setting) for case, setting in params.calibrated]
write_every_inference_data(folder, outcome, map(inference_groups, outcome))
write_csv(folder / "tables" / "posteriors.csv", parameters_table(outcome))
write_csv(folder / "tables" / "curves.csv", curves_table(outcome))

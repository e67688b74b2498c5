"""Write the report of the whole study as one page."""

from pathlib import Path

from heartfit.io.files import write_text
from heartfit.io.noise_models import read_noise_model
from heartfit.io.report import assets, read_study_results
from heartfit.io.run import record
from heartfit.results.report.page import render

record(snakemake.log[0])
params = snakemake.params
noise = [read_noise_model(Path(file)) for file in snakemake.input.noise]
study = read_study_results(Path(params.results), params.study, params.cases, noise, params.left_out)
write_text(Path(snakemake.output[0]), render(study, assets()))

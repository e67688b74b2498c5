"""Judge every number that the paper states, with ours."""

from pathlib import Path

from heartfit.io.campaign import read_benchmarks
from heartfit.io.noise_models import read_noise_model
from heartfit.io.results import read_case, read_sensitivity
from heartfit.io.run import record
from heartfit.io.tables import read_published, write_tables
from heartfit.results.claims import claims_table
from heartfit.results.findings import StudyResults
from heartfit.results.text import render_tables

record(snakemake.log[0])
files, params = snakemake.input, snakemake.params
folder = Path(params.results)
results = StudyResults(
    cases=[read_case(Path(file)) for file in files.cases],
    groups=params.groups,
    costs=read_benchmarks(folder / "benchmarks"),
    sensitivities={
        name: read_sensitivity(Path(file))
        for name, file in zip(params.settings, files.sensitivities, strict=True)
    },
    selection=[read_published(Path(file)) for file in files.selection],
    noise=[read_noise_model(Path(file)) for file in files.noise],
    planted_ratios=params.planted_ratios,
)
claims = read_published(Path(files.claims))
write_tables(folder / "tables", render_tables({"claims": claims_table(claims, results)}))

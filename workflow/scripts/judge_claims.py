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
sensitivities = map(read_sensitivity, map(Path, files.sensitivities))
results = StudyResults(
    cases=list(map(read_case, map(Path, files.cases))),
    groups=params.groups,
    costs=read_benchmarks(folder / "benchmarks"),
    sensitivities=dict(zip(params.settings, sensitivities, strict=True)),
    selection=list(map(read_published, map(Path, files.selection))),
    noise=list(map(read_noise_model, map(Path, files.noise))),
    planted_ratios=params.planted_ratios,
)
claims = read_published(Path(files.claims))
write_tables(folder / "tables", render_tables({"claims": claims_table(claims, results)}))

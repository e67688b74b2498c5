"""One page of the whole study that opens from a file."""

from pathlib import Path

from heartfit.io.log import record
from heartfit.io.report import read_study_results, write_report

record(snakemake.log[0])
given = snakemake.params
study = read_study_results(Path(given.results), given.study, given.cases, given.left_out)
write_report(Path(snakemake.output[0]), study)

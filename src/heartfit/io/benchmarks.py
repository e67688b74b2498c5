"""What Snakemake measured of each job."""

import csv
from pathlib import Path

from heartfit.errors import InputError
from heartfit.planning.need import Cost

COLUMNS = {"s", "max_rss", "cpu_time"}


def read_benchmarks(folder: Path) -> list[Cost]:
    """The costs of all jobs of a study, named by their benchmark files' places; raises InputError if there are none."""
    files = sorted(Path(folder).rglob("*.tsv"))
    if not files:
        raise InputError(f"{folder}: no benchmark of a job; expected those of a study: `snakemake --cores 2`")
    return [_read(file, file.relative_to(folder).with_suffix("").as_posix()) for file in files]


def _read(file: Path, job: str) -> Cost:
    with file.open(newline="") as stream:
        row = next(csv.DictReader(stream, delimiter="\t"), {})
    if not set(row) >= COLUMNS:
        raise InputError(
            f"{file}: no benchmark; expected the columns {', '.join(sorted(COLUMNS))}; delete it"
        )
    return Cost(job, float(row["s"]), _sampled(row["cpu_time"]), _sampled(row["max_rss"]))


def _sampled(text: str) -> float:
    """A job that ended before its first sample has none."""
    return 0.0 if text in ("NA", "-") else float(text)

"""Tables written; tables of a study and published tables read."""

import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd

from heartfit.core.errors import InputError
from heartfit.io.files import write_text
from heartfit.io.fingerprint import made_by
from heartfit.results.text import RenderedTable

COMMENTS = {
    ".csv": "# {comment}\n{text}",
    ".md": "{text}\n<!-- {comment} -->\n",
    ".tex": "% {comment}\n{text}",
}
"""Place of the provenance in a table: a comment that rendered output does not show."""


def write_csv(path: Path, frame: pd.DataFrame) -> None:
    """Write numbers to six digits below a comment with their provenance."""
    _write(path, frame.to_csv(index=False, float_format="%.6g", lineterminator="\n"))


def write_table(path: Path, table: RenderedTable) -> None:
    """Write as CSV, Markdown or LaTeX by the suffix; raises ValueError for another one."""
    suffix = Path(path).suffix
    if suffix not in COMMENTS:
        raise ValueError(
            f"{path}: tables are written as {', '.join(COMMENTS)}, not {suffix or 'without suffix'}"
        )
    if suffix == ".csv":
        write_csv(path, table.frame)
    else:
        _write(path, table.markdown if suffix == ".md" else table.latex)


def write_tables(folder: Path, tables: Mapping[str, RenderedTable]) -> None:
    """Write each table by its name in all three formats."""
    for name, table in tables.items():
        for suffix in COMMENTS:
            write_table(Path(folder, f"{name}{suffix}"), table)


def write_measured(path: Path, frame: pd.DataFrame, command: str) -> None:
    """Write a result of docs/measured, tab-separated, below a line with its command and the commit of the sources."""
    query = ("git", "rev-parse", "--short", "HEAD")
    commit = subprocess.run(query, capture_output=True, text=True, check=False).stdout.strip() or "unknown"
    table = frame.to_csv(sep="\t", index=False, lineterminator="\n")
    write_text(path, f"# made by: {command}; commit: {commit}\n{table}")


def write_measured_tables(
    paths: Sequence[str], prefix: str, tables: Mapping[str, pd.DataFrame], command: str
) -> None:
    """Write to each path PREFIX_NAME.tsv the table of this name."""
    for path in map(Path, paths):
        write_measured(path, tables[path.stem.removeprefix(f"{prefix}_")], command)


def _write(path: Path, text: str) -> None:
    write_text(path, COMMENTS[Path(path).suffix].format(text=text, comment=f"made by {made_by()}"))


def read_numbers(path: Path) -> pd.DataFrame:
    """Read the numbers of a study, values as text; raises InputError for a missing file."""
    if not Path(path).is_file():
        raise InputError(f"{path}: no such file; expected the numbers of a study: run `snakemake --cores 2`")
    return pd.read_csv(path, dtype=str, keep_default_na=False, comment="#")


def read_shards(results: Sequence[Path]) -> dict[str, pd.DataFrame]:
    """Read the numbers of each shard by its folder; raises InputError for a folder without numbers."""
    return {str(folder): read_numbers(folder / "tables" / "numbers.csv") for folder in results}


def read_claims(path: Path) -> pd.DataFrame:
    """Read a tab-separated table of claims; lines that begin with # are comments."""
    if not Path(path).is_file():
        raise InputError(f"{path}: no such file; expected a table of claims")
    return pd.read_csv(path, sep="\t", comment="#")


def read_published(path: Path) -> pd.DataFrame:
    """Read a published table or one of a study, separated as its suffix says; lines that begin with # are comments."""
    if not Path(path).is_file():
        raise InputError(f"{path}: no such file; expected a published table under resources/")
    return pd.read_csv(path, sep="\t" if Path(path).suffix == ".tsv" else ",", comment="#")


def read_shape(path: Path) -> pd.DataFrame:
    """Read the shape of a motion over the beat; no rows if the beat failed."""
    if not Path(path).is_file():
        raise InputError(
            f"{path}: no such file; expected the shape of a calibrated motion: simulate it first"
        )
    return pd.read_csv(path, comment="#")

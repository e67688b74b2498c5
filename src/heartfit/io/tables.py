"""Tables and figures out, published tables in."""

from collections.abc import Mapping
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from heartfit.errors import InputError
from heartfit.io.atomic import replacing, write_text
from heartfit.io.made_by import made_by
from heartfit.tables.notes import NOTES
from heartfit.tables.text import to_latex, to_markdown

WRITERS = {
    ".csv": lambda table: table.to_csv(index=False, float_format="%.6g", lineterminator="\n"),
    ".md": to_markdown,
    ".tex": to_latex,
}
COMMENTS = {
    ".csv": "# {comment}\n{text}",
    ".md": "{text}\n<!-- {comment} -->\n",
    ".tex": "% {comment}\n{text}",
}
"""Where a table says what it was made by: nobody reads it who does not look for it."""


def write_table(path: Path, table: pd.DataFrame, note: str = "") -> None:
    """Write as CSV, Markdown or LaTeX by the suffix, Markdown with a note below; raises ValueError for another one."""
    suffix = Path(path).suffix
    if suffix not in WRITERS:
        raise ValueError(
            f"{path}: tables are written as {', '.join(WRITERS)}, not {suffix or 'without suffix'}"
        )
    text = WRITERS[suffix](table)
    if note and suffix == ".md":
        text += f"\n{note}\n"
    write_text(path, COMMENTS[suffix].format(text=text, comment=f"made by {made_by()}"))


def write_tables(folder: Path, tables: Mapping[str, pd.DataFrame]) -> None:
    """Write each table by its name in all three formats, with its note if there is one in heartfit.tables.notes."""
    for name, table in tables.items():
        for suffix in WRITERS:
            write_table(Path(folder, f"{name}{suffix}"), table, NOTES.get(name, ""))


def write_figures(folder: Path, figures: Mapping[str, Figure]) -> None:
    """Write each figure by its name as PNG and PDF."""
    for name, figure in figures.items():
        for suffix in ("png", "pdf"):
            write_figure(Path(folder, f"{name}.{suffix}"), figure)


def read_numbers(path: Path) -> pd.DataFrame:
    """The numbers of a study that write_table wrote as CSV, values as text."""
    if not Path(path).is_file():
        raise InputError(
            f"{path}: no such file; expected the numbers of a study: `snakemake --cores 2` makes them"
        )
    return pd.read_csv(path, dtype=str, keep_default_na=False, comment="#")


def read_tolerances(path: Path) -> pd.DataFrame:
    """A table of tolerances, separated by tabs; lines that begin with # tell of it. Raises InputError for none."""
    if not Path(path).is_file():
        raise InputError(f"{path}: no such file; expected a table of tolerances")
    return pd.read_csv(path, sep="\t", comment="#")


def read_published(path: Path) -> pd.DataFrame:
    """A published table; lines that begin with # tell its origin."""
    if not Path(path).is_file():
        raise InputError(f"{path}: no such file; expected a published table under resources/")
    return pd.read_csv(path, comment="#")


def read_shape(path: Path) -> pd.DataFrame:
    """The shape of a motion that write_table wrote as CSV; no rows if the beat failed."""
    if not Path(path).is_file():
        raise InputError(
            f"{path}: no such file; expected the shape of a calibrated motion: simulate it first"
        )
    return pd.read_csv(path, comment="#")


def write_figure(path: Path, figure: Figure) -> None:
    """Write in the format of the suffix (png, pdf, svg), without the time of writing in it."""
    date = {"png": "Software", "pdf": "CreationDate", "svg": "Date"}.get(Path(path).suffix[1:])
    with replacing(path) as draft:
        figure.savefig(draft, dpi=200, metadata={date: None} if date else None)

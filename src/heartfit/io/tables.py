"""Tables and figures out, published tables in."""

from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from heartfit.errors import InputError
from heartfit.io.atomic import replacing, write_text
from heartfit.tables.text import to_latex, to_markdown

WRITERS = {
    ".csv": lambda table: table.to_csv(index=False, float_format="%.6g", lineterminator="\n"),
    ".md": to_markdown,
    ".tex": to_latex,
}


def write_table(path: Path, table: pd.DataFrame) -> None:
    """Write as CSV, Markdown or LaTeX by the suffix; raises ValueError for another one."""
    suffix = Path(path).suffix
    if suffix not in WRITERS:
        raise ValueError(
            f"{path}: tables are written as {', '.join(WRITERS)}, not {suffix or 'without suffix'}"
        )
    write_text(path, WRITERS[suffix](table))


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
    return pd.read_csv(path)


def write_figure(path: Path, figure: Figure) -> None:
    """Write in the format of the suffix (png, pdf, svg), without the time of writing in it."""
    date = {"png": "Software", "pdf": "CreationDate", "svg": "Date"}.get(Path(path).suffix[1:])
    with replacing(path) as draft:
        figure.savefig(draft, dpi=200, metadata={date: None} if date else None)

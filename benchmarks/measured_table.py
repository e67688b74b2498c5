"""Tables that benchmarks measure, in docs/measured."""

import pandas as pd

from benchmarks.ventricles import ROOT
from heartfit.io.tables import write_measured

FOLDER = ROOT / "docs" / "measured"


def read_table(name: str) -> pd.DataFrame:
    """Read docs/measured/NAME.tsv as text; a table without rows if there is none."""
    path = FOLDER / f"{name}.tsv"
    if not path.exists():
        return pd.DataFrame()
    return pd.read_csv(path, sep="\t", comment="#", dtype=str, keep_default_na=False)


def store_table(name: str, table: pd.DataFrame, module: str) -> None:
    """Write docs/measured/NAME.tsv, made by a module with its arguments."""
    write_measured(FOLDER / f"{name}.tsv", table, f"python -m {module}")

"""Tables that benchmarks measure, in docs/measured."""

import pandas as pd

from benchmarks.ventricles import ROOT
from heartfit.io.files import write_text

FOLDER = ROOT / "docs" / "measured"


def read_table(name: str) -> pd.DataFrame:
    """Read docs/measured/NAME.tsv as text; a table without rows if there is none."""
    path = FOLDER / f"{name}.tsv"
    if not path.exists():
        return pd.DataFrame()
    return pd.read_csv(path, sep="\t", comment="#", dtype=str, keep_default_na=False)


def store_table(name: str, table: pd.DataFrame, module: str) -> None:
    """Write docs/measured/NAME.tsv, made by a module with its arguments."""
    text = table.to_csv(sep="\t", index=False)
    write_text(FOLDER / f"{name}.tsv", f"# made by: python -m {module}\n{text}")

"""Tables that benchmarks measure, in docs/measured."""

import pandas as pd

from benchmarks.ventricles import ROOT
from heartfit.io.files import write_text


def store_table(name: str, table: pd.DataFrame, module: str) -> None:
    """Write docs/measured/NAME.tsv, made by a module with its arguments."""
    text = table.to_csv(sep="\t", index=False)
    write_text(ROOT / "docs" / "measured" / f"{name}.tsv", f"# made by: python -m {module}\n{text}")

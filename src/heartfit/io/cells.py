"""The cells of a CSV table as they are written, by column."""

import re
from pathlib import Path
from typing import TYPE_CHECKING

from heartfit.errors import InputError

if TYPE_CHECKING:
    import pandas as pd  # 0.2 s to import, and what only writes does without


def read_cells(path: Path) -> "pd.DataFrame":
    """Text by column; lines that begin with # are remarks. Raises InputError for what is no table with commas."""
    import pandas as pd

    if not Path(path).is_file():
        raise InputError(f"{path}: no such file; expected curves as CSV: correct the path")
    try:
        table = pd.read_csv(
            path, comment="#", skipinitialspace=True, dtype=str, keep_default_na=False, encoding="utf-8-sig"
        )
    except (pd.errors.ParserError, pd.errors.EmptyDataError, UnicodeDecodeError) as error:
        said = " ".join(str(error).split())
        raise InputError(
            f"{path}: not a CSV table ({said}); expected a header such as time_s,lv_volume_ml"
        ) from error
    if len(table.columns) == 1 and re.search(r"[;\t]", table.columns[0]):
        raise InputError(
            f"{path}: no commas between columns; expected these, and points in numbers: export it anew"
        )
    return table

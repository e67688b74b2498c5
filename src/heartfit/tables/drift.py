"""Numbers that may not move unnoticed, beside what they were."""

from collections.abc import Hashable, Mapping
from typing import Any

import pandas as pd

from heartfit.errors import InputError

KEY = ["table", "setting", "case", "quantity"]
COLUMNS = [*KEY, "expected", "tolerance", "why"]
ADVICE = (
    "find the change that moved them; if they are right now, write the expected ones anew with `heartfit tolerances`, "
    "see docs/what_the_numbers_mean.md"
)


class DriftError(InputError):
    """Numbers of the study are not what they were."""


def require_no_drift(numbers: pd.DataFrame, tolerances: pd.DataFrame) -> pd.DataFrame:
    """The tolerances with what was measured; raises DriftError that lists every number that is off or not there.

    numbers: see heartfit.tables.provenance; tolerances: table, setting, case, quantity, expected and tolerance in the
    table's unit, why. Raises InputError for a table of tolerances that has other columns or no row.
    """
    found = with_measured(numbers, tolerances)
    off = found[~((found["measured"] - found["expected"]).abs() <= found["tolerance"])]  # NaN is off as well
    if not off.empty:
        raise DriftError(
            "\n".join(
                [f"{len(off)} of {len(found)} numbers drifted:", *map(_line, off.to_dict("records")), ADVICE]
            )
        )
    return found


def _line(row: Mapping[Hashable, Any]) -> str:
    where = ", ".join(row[key] for key in KEY)
    return f"  {where}: expected {row['expected']:g} within {row['tolerance']:g}, found {row['measured']:g}"


def with_measured(numbers: pd.DataFrame, tolerances: pd.DataFrame) -> pd.DataFrame:
    """The tolerances with a column "measured", NaN where the study has no such number."""
    if list(tolerances.columns) != COLUMNS or tolerances.empty:
        raise InputError(
            f"tolerances: {len(tolerances)} rows of {', '.join(tolerances.columns)}; "
            f"expected one or more of {', '.join(COLUMNS)}"
        )
    measured = numbers[[*KEY, "value"]].rename(columns={"value": "measured"})
    found = tolerances.merge(measured, "left", on=KEY, validate="one_to_one")
    return found.assign(measured=pd.to_numeric(found["measured"], errors="coerce"))[
        [*KEY, "measured", *COLUMNS[4:]]
    ]


def renewed(numbers: pd.DataFrame, tolerances: pd.DataFrame) -> pd.DataFrame:
    """The same tolerances about the numbers of this study; a number that is not there keeps what was expected."""
    found = with_measured(numbers, tolerances)
    return found.assign(expected=found["measured"].fillna(found["expected"]))[COLUMNS]

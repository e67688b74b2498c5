"""The numbers of shards as those of one study."""

from collections.abc import Mapping

import pandas as pd

from heartfit.errors import InputError

ROW = ["table", "setting", "case", "quantity"]
SAME = ["value", "unit", "fingerprint"]


def joined(numbers: Mapping[str, pd.DataFrame]) -> pd.DataFrame:
    """All rows; of one that several shards have, the first, if they agree in value and code.

    numbers: those of each shard by its name. Raises InputError otherwise: shards of different code or machines.
    """
    every = pd.concat([table.assign(shard=name) for name, table in numbers.items()], ignore_index=True)
    kinds = every.drop_duplicates([*ROW, *SAME])
    twice = kinds[kinds.duplicated(ROW, keep=False)]
    if len(twice):
        first, other = twice[twice[ROW].eq(twice.iloc[0][ROW]).all(axis=1)].head(2).to_dict("records")
        raise InputError(
            f"{other['shard']}: {other['quantity']} of {other['case']} is {other['value']}, in {first['shard']} "
            f"{first['value']}; expected the same numbers by the same code: run both anew"
        )
    return every.drop_duplicates(ROW).reset_index(drop=True)


def summary(numbers: pd.DataFrame) -> pd.DataFrame:
    """Mean, deviation, least and largest of every quantity over the cases, one row for each table and setting."""
    values = numbers.assign(value=pd.to_numeric(numbers["value"], errors="coerce")).dropna(subset=["value"])
    grouped = values.groupby(["table", "setting", "quantity", "unit"], sort=False, dropna=False)["value"]
    found = grouped.agg(cases="count", mean="mean", sd="std", least="min", largest="max")
    return found.reset_index()

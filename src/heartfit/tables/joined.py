"""The numbers of shards as those of one study."""

from collections.abc import Iterator, Mapping

import pandas as pd

from heartfit.errors import InputError

ROW = ["table", "setting", "case", "quantity"]
SAME = ["value", "unit", "fingerprint"]
OF_COHORT = r"(?:over|healthy) mean$"
RATIOS = {"": " over mean", " value": " over healthy mean"}
"""What follows a parameter's name where it is an estimate, and where it is that over the healthy mean."""


def joined(numbers: Mapping[str, pd.DataFrame]) -> pd.DataFrame:
    """All rows of a case; of one that several shards have, the first, if they agree in value and code.

    numbers: those of each shard by its name. What rests on the healthy of one shard is left out, means and ratios to
    them; estimates over the mean of the virtual volunteers are taken anew, of all shards. Raises InputError for shards
    of different code or machines.
    """
    every = pd.concat([table.assign(shard=name) for name, table in numbers.items()], ignore_index=True)
    of_cohort = every["quantity"].str.contains(OF_COHORT) | every["case"].str.startswith("mean of ")
    of_shard = of_cohort & (every["fingerprint"] != "")
    alone = _agreed(every[~of_shard])
    return pd.concat([alone, *_over_healthy(alone, every[of_shard])], ignore_index=True)


def calibrated(numbers: pd.DataFrame) -> set[str]:
    """The cases that rows of a run tell of: neither a prior nor the paper's."""
    return {*numbers.loc[numbers["parameters"] != "", "case"]}


def _over_healthy(rows: pd.DataFrame, of_shard: pd.DataFrame) -> Iterator[pd.DataFrame]:
    """Ratios to the mean of the virtual volunteers, for those that the shards have of their own."""
    estimated = rows.assign(value=pd.to_numeric(rows["value"], errors="coerce")).dropna(subset=["value"])
    virtual = estimated[(estimated["table"] == "table2") & (estimated["seed"] != "")]
    means = virtual.groupby(["setting", "quantity"])["value"].mean()
    for ending, ratio in RATIOS.items():
        names = estimated["quantity"].str.removesuffix(ending)
        mean = pd.MultiIndex.from_arrays([estimated["setting"], names]).map(means)
        over = estimated.assign(quantity=names + ratio, value=estimated["value"] / mean, unit="")
        yield over.merge(of_shard[ROW].drop_duplicates(), on=ROW)


def _agreed(every: pd.DataFrame) -> pd.DataFrame:
    """Each row once; raises InputError if a row has two values."""
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

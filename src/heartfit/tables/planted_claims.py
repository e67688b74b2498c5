"""What is claimed of the search for causes, held to a count of hidden effects."""

from collections.abc import Hashable, Mapping, Sequence
from typing import Any

import pandas as pd

from heartfit.errors import InputError
from heartfit.planting.rates import RATES, doubt
from heartfit.planting.scoring import Scored

COLUMNS = ["rate", "claim", "bound", "why"]
BOUNDS = ("at most", "at least")
BY_NAME = {rate.name: rate for rate in RATES}
REFUTED = 0.01
"""Probability below which a count refutes a claim: a search that is as good as claimed fails in one of a hundred."""


class ClaimError(InputError):
    """The search for causes is not what it is claimed to be."""


def require_claims(scored: Sequence[Scored], claims: pd.DataFrame) -> pd.DataFrame:
    """The claims beside the counts; raises ClaimError with those that are refuted, InputError for a broken table.

    A claim of which there is no case is left out.
    """
    _check(claims)
    rows = [row | _counted(scored, row) for row in claims.to_dict("records")]
    held = pd.DataFrame([row for row in rows if row["counted"]])
    refuted = [_line(row) for row in rows if row["doubt"] < REFUTED]
    if refuted:
        raise ClaimError("\n".join([f"{len(refuted)} of {len(held)} claims refuted:", *refuted]))
    return held


def _check(claims: pd.DataFrame) -> None:
    known = set(claims.get("rate", ())) <= set(BY_NAME) and set(claims.get("bound", ())) <= set(BOUNDS)
    if list(claims.columns) != COLUMNS or not known:
        raise InputError(
            f"claims: columns {', '.join(claims.columns)}; expected {', '.join(COLUMNS)}, rates among "
            f"{', '.join(BY_NAME)}, bounds {' or '.join(BOUNDS)}"
        )


def _counted(scored: Sequence[Scored], row: Mapping[Hashable, Any]) -> dict[Hashable, Any]:
    share = BY_NAME[row["rate"]].counted(scored)
    if share is None:
        return {"counted": "", "doubt": 1.0}
    count = f"{round(share.covered * share.sequences)} of {share.sequences}"
    return {"counted": count, "doubt": doubt(share, row["claim"], row["bound"] == BOUNDS[0])}


def _line(row: Mapping[Hashable, Any]) -> str:
    claim = f"claimed {row['bound']} {row['claim']:g}, probability {row['doubt']:.1g}"
    return f"  {row['rate']}: {row['counted']}, {claim}"

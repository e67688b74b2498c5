"""What less and more data show of the same hidden effects."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from heartfit.planting.scoring import Scored
from heartfit.planting.trial import CONDITION, VOLUME
from heartfit.tables.text import to_markdown

SECTION = """
## With less data, and with more

Of these hearts {nulls} without an effect and {singles} with one mechanism of {scales} scales were searched by their
volume alone as well, and with a recording under another loading, the legs raised. That is never fitted: it decides
which names are kept: one that does not help there is withdrawn, and of a group what has become less likely. Held-out
errors are with the named cause over without, medians over right names; without another condition they are of half of
the recording.

{table}"""


def by_data_section(scored: Sequence[Scored]) -> str:
    """The section of the page in Markdown; empty where no heart was searched by less and more data."""
    cases = _searched(scored)
    if not cases:
        return ""
    kinds = [each.answer.kind for each in cases]
    return SECTION.format(
        nulls=kinds.count("none"),
        singles=kinds.count("single"),
        scales=f"{max(each.scales for each in cases):g}",
        table=to_markdown(by_data_table(cases)),
    )


def by_data_table(scored: Sequence[Scored]) -> pd.DataFrame:
    """One row for each set of data, over the cases that were searched by all of them."""
    cases = _searched(scored)
    said = {
        VOLUME: [each.told(VOLUME) for each in cases],
        "volume and pressure": cases,
        CONDITION: [each.told(CONDITION) for each in cases],
    }
    return pd.DataFrame([{"data": data} | _counts(each) for data, each in said.items()])


def _searched(scored: Sequence[Scored]) -> list[Scored]:
    return [each for each in scored if each.finding.other]


def _counts(cases: Sequence[Scored]) -> dict[str, Any]:
    nulls, singles = ([each for each in cases if each.answer.kind == kind] for kind in ("none", "single"))
    right = [each for each in singles if each.right]
    return {
        "false alarms": f"{sum(each.detected for each in nulls)} of {len(nulls)}",
        "detected": f"{sum(each.detected for each in singles)} of {len(singles)}",
        "named right": len(right),
        "in their group": sum(each.in_group for each in singles),
        "named wrong": sum(each.named and not each.right for each in cases),
        "insufficient": sum(each.finding.verdict == "insufficient" for each in cases),
        "held-out volume": _median(right, "lv_volume"),
        "held-out pressure": _median(right, "lv_pressure"),
    }


def _median(cases: Sequence[Scored], curve: str) -> float:
    ratios = [each.finding.gain[curve] for each in cases if curve in each.finding.gain]
    return float(np.median(ratios)) if ratios else float("nan")

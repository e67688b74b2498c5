"""Findings of a study whose hidden effects are known: which of the stored ones a later study has lost.

Numbers may move between machines; a finding may not. A stored finding is the name of a hidden effect of a sealed heart,
or the verdict "none" of a sealed heart without an effect.
"""

from collections.abc import Mapping

import pandas as pd

from heartfit.core.errors import InputError

TABLE = "discovery"
HIDDEN, SAID = "hidden", "verdict after the refit"
"""Rows of the table of discovery: the answer of a sealed heart, and the verdict on it."""
NOTHING, NONE = "nothing", "none"


def require_findings(stored: Mapping[str, pd.DataFrame], tables: Mapping[str, pd.DataFrame]) -> None:
    """Raise InputError if the tables lack a finding of the stored tables."""
    before, now = (_found(held.get(TABLE)) for held in (stored, tables))
    lost = [
        f"{case}: {now.get(case, ('', 'not searched'))[1]}; hidden is {hidden}, and the stored tables say {verdict}"
        for case, (hidden, verdict) in before.items()
        if _is_true(hidden, verdict) and not (case in now and _is_true(*now[case]))
    ]
    if lost:
        raise InputError(
            f"a finding is lost: {'; '.join(lost)}. A change of the code, the configuration or the data caused it, "
            "not the processor: find it before anything is stored"
        )


def _found(table: pd.DataFrame | None) -> dict[str, tuple[str, str]]:
    """Return the hidden effects and the verdict of each sealed case, as text."""
    if table is None:
        return {}
    texts = {
        (row["case"], row["quantity"]): row["text"]
        for row in table.to_dict("records")
        if row["quantity"] in (HIDDEN, SAID)
    }
    return {
        case: (text, texts.get((case, SAID), ""))
        for (case, quantity), text in texts.items()
        if quantity == HIDDEN
    }


def _is_true(hidden: str, verdict: str) -> bool:
    """True if the verdict names every hidden effect, or says "none" where nothing is hidden."""
    names = [effect.partition(",")[0] for effect in hidden.split("; ")]
    if names == [NOTHING]:
        return verdict == NONE
    named = verdict.partition(" (")[0].partition(": ")[2].split(" and ")
    return set(names) <= set(named)

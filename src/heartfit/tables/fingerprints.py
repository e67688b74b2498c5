"""Rows of one table come from one state of the code."""

from collections.abc import Sequence

from heartfit.tables.case import CaseResult


class FingerprintMismatchError(ValueError):
    """Results of different code were put side by side."""


def require_one_fingerprint(cases: Sequence[CaseResult]) -> str:
    """The fingerprint all cases share; raises FingerprintMismatchError that lists who has which."""
    if not cases:
        raise ValueError("table: no cases; expected at least one result")
    owners: dict[str, list[str]] = {}
    for case in cases:
        owners.setdefault(case.fingerprint, []).append(f"{case.case}/{case.setting}")
    if len(owners) > 1:
        who = "; ".join(f"{fingerprint}: {', '.join(names)}" for fingerprint, names in owners.items())
        raise FingerprintMismatchError(
            f"table: results of different code ({who}): run the study again for the older ones"
        )
    return cases[0].fingerprint

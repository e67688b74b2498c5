"""The one place where a virtual volunteer's truth is looked at."""

from collections.abc import Mapping

from heartfit.tables.case import CaseResult, relative_errors

WITHOUT_TRUTH = ("K",)
"""K is felt through the locking of linear tetrahedra only: the hidden heart, on another element, has no true one."""


def comparable(truth: Mapping[str, float]) -> dict[str, float]:
    """What of a truth an estimate can be held against."""
    return {name: value for name, value in truth.items() if name not in WITHOUT_TRUTH}


def truth_errors(case: CaseResult, truth: Mapping[str, float]) -> dict[str, float]:
    """Signed relative error in percent of each estimated parameter the truth knows; truth SI by name."""
    known = comparable(truth)
    return relative_errors(case.estimate, {name: known[name] for name in case.estimate if name in known})

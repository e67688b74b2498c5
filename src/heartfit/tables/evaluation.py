"""The one place where a virtual volunteer's truth is looked at."""

from collections.abc import Mapping

from heartfit.tables.case import CaseResult, relative_errors


def truth_errors(case: CaseResult, truth: Mapping[str, float]) -> dict[str, float]:
    """Signed relative error in percent of each estimated parameter the truth knows; truth SI by name."""
    return relative_errors(case.estimate, {name: truth[name] for name in case.estimate if name in truth})

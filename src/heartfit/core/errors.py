"""Errors in the input, which the user can correct.

A computation that fails is a result with a status and a reason, not an exception.
"""

from collections.abc import Iterable


class InputError(ValueError):
    """Bad input: the message names the mistake, its place, the expected value and the correction."""

    @property
    def problems(self) -> tuple[str, ...]:
        """One line for every mistake."""
        return (str(self),)


class InputErrors(InputError):
    """Several mistakes at once; their text is the first one and the number of the others."""

    def __init__(self, problems: Iterable[str]) -> None:
        self._problems = tuple(problems)
        others = len(self._problems) - 1
        more = f" (and {others} more)" if others else ""
        super().__init__(self._problems[0] + more)

    @property
    def problems(self) -> tuple[str, ...]:
        return self._problems


def require_none(problems: Iterable[str]) -> None:
    """Raise InputErrors if there is any problem; equal problems count once."""
    unique = tuple(dict.fromkeys(problems))
    if unique:
        raise InputErrors(unique)

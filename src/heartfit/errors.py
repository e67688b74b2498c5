"""What the user can mend is an InputError; what the numbers did is a status, not an exception."""

from collections.abc import Iterable


class InputError(ValueError):
    """Bad input: the message says what, where, what was expected and what to do."""

    @property
    def problems(self) -> tuple[str, ...]:
        """Every mistake that was found, in a line each."""
        return (str(self),)


class InputErrors(InputError):
    """Several mistakes at once; as text the first of them, and how many more there are."""

    def __init__(self, problems: Iterable[str]) -> None:
        self._problems = tuple(problems)
        others = len(self._problems) - 1
        more = f" (and {others} more)" if others else ""
        super().__init__(self._problems[0] + more)

    @property
    def problems(self) -> tuple[str, ...]:
        return self._problems


def require_none(problems: Iterable[str]) -> None:
    """Raise InputErrors if there is any problem."""
    found = tuple(dict.fromkeys(problems))
    if found:
        raise InputErrors(found)

"""One mechanism per file; the folder is the registry (see :mod:`heartfit.roles`).

``heartfit.mechanisms.MitralRegurgitation`` is the registered mechanism of that name, from whatever file or package.
"""

from typing import Any

from heartfit.roles import registered, require_registered


def __getattr__(name: str) -> Any:
    """Return a mechanism by its name; raises AttributeError with the nearest known name."""
    if not name[0].isupper():
        raise AttributeError(name)
    try:
        return require_registered(name)
    except KeyError as unknown:
        raise AttributeError(unknown.args[0]) from None


def __dir__() -> list[str]:
    return list(registered())

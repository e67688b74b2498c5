"""Registry of mechanisms: the folder ``heartfit/mechanisms`` and the entry points of installed packages."""

import importlib
import pkgutil
from difflib import get_close_matches
from functools import cache
from importlib.metadata import entry_points
from typing import TypeVar

from heartfit.roles.interfaces import (
    Amendment,
    Attachment,
    Availability,
    Chamber,
    Contraction,
    Delay,
    Dynamics,
    External,
    Flow,
    Mechanism,
    Narrowing,
    Pressure,
    Relaxation,
    Sensor,
    Stress,
)
from heartfit.roles.requirements import require_complete

ROLES: tuple[type[Mechanism], ...] = (
    *(Amendment, Attachment, Availability, Delay, Relaxation, Stress),
    *(Flow, Dynamics, Narrowing, Contraction, Pressure, Chamber, External),
    Sensor,
)

M = TypeVar("M", bound=type[Mechanism])

GROUP = "heartfit.mechanisms"
"""Group of entry points under which another package names its modules of mechanisms."""

_REGISTRY: dict[str, type[Mechanism]] = {}


def mechanism(cls: M) -> M:
    """Register a mechanism under its class name; the same name of the same module, as of a cell run again, replaces.

    Raises ``TypeError`` for a class without a role, for one that lacks what its role needs (a method, a compartment or
    a valve that exists, exactly one switch), and for a name that another module has registered.
    """
    if not issubclass(cls, ROLES):
        raise TypeError(f"{cls.__name__} plays no role: derive it from one of {[r.__name__ for r in ROLES]}")
    other = _REGISTRY.get(cls.__name__, cls)
    if other.__module__ != cls.__module__:
        raise TypeError(
            f"mechanism {cls.__name__} is registered twice, by {other.__module__} and {cls.__module__}: "
            "rename one of them"
        )
    require_complete(cls)
    _REGISTRY[cls.__name__] = cls
    return cls


def registered() -> dict[str, type[Mechanism]]:
    """Return all mechanisms of the folder ``heartfit/mechanisms`` and of installed packages, by name."""
    _import_modules()
    return dict(sorted(_REGISTRY.items()))


def require_registered(name: str) -> type[Mechanism]:
    """Return a registered mechanism by its name; raises KeyError with the nearest known name."""
    known = registered()
    if name not in known:
        near = get_close_matches(name, known, n=1, cutoff=0.0)[0]
        raise KeyError(f"mechanism {name!r} is unknown; did you mean {near}? `heartfit parameters` lists all")
    return known[name]


@cache
def _import_modules() -> None:
    """Import the modules of all mechanisms; cached, because a study reads the registry tens of thousands of times."""
    package = importlib.import_module("heartfit.mechanisms")
    for module in pkgutil.iter_modules(package.__path__):
        importlib.import_module(f"heartfit.mechanisms.{module.name}")
    for entry_point in entry_points(group=GROUP):
        entry_point.load()

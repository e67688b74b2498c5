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
    """Register a mechanism under its class name.

    Raises ``TypeError`` for a class without a role or without exactly one switch, and for a name that is registered.
    """
    if not issubclass(cls, ROLES):
        raise TypeError(f"{cls.__name__} plays no role: derive it from one of {[r.__name__ for r in ROLES]}")
    cls.switch()
    if _REGISTRY.setdefault(cls.__name__, cls) is not cls:
        raise TypeError(f"mechanism {cls.__name__} is registered twice: rename one of them")
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

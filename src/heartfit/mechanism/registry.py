"""The registry of mechanisms: the folder ``heartfit/mechanisms``, and what installed packages offer."""

import importlib
import pkgutil
from functools import cache
from importlib.metadata import entry_points
from typing import TypeVar

from heartfit.mechanism.base import Mechanism
from heartfit.mechanism.blood import External, Flow, Narrowing, Pressure
from heartfit.mechanism.instrument import Sensor
from heartfit.mechanism.muscle import Amendment, Availability, Delay, Relaxation, Stress

ROLES: tuple[type[Mechanism], ...] = (
    *(Amendment, Availability, Delay, Relaxation, Stress),
    *(Flow, Narrowing, Pressure, External),
    Sensor,
)

M = TypeVar("M", bound=type[Mechanism])

GROUP = "heartfit.mechanisms"
"""Entry points under which another package names its modules of mechanisms."""

_REGISTRY: dict[str, type[Mechanism]] = {}


def mechanism(cls: M) -> M:
    """Register a mechanism under its class name; ``TypeError`` without a role or with a name taken."""
    if not issubclass(cls, ROLES):
        raise TypeError(f"{cls.__name__} plays no role: derive it from one of {[r.__name__ for r in ROLES]}")
    cls.switch()
    if _REGISTRY.setdefault(cls.__name__, cls) is not cls:
        raise TypeError(f"mechanism {cls.__name__} is registered twice: rename one of them")
    return cls


def registered() -> dict[str, type[Mechanism]]:
    """All mechanisms of the folder ``heartfit/mechanisms`` and of installed packages, by name."""
    _import_all()
    return dict(sorted(_REGISTRY.items()))


@cache
def _import_all() -> None:
    """Once: the graph of a study asks for the registry tens of thousands of times."""
    package = importlib.import_module("heartfit.mechanisms")
    for module in pkgutil.iter_modules(package.__path__):
        importlib.import_module(f"heartfit.mechanisms.{module.name}")
    for offered in entry_points(group=GROUP):
        offered.load()

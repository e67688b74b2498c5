"""The registry of mechanisms: the folder ``heartfit/mechanisms``."""

import importlib
import pkgutil
from functools import cache
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
    """All mechanisms of the folder ``heartfit/mechanisms``, by name."""
    _import_folder()
    return dict(sorted(_REGISTRY.items()))


@cache
def _import_folder() -> None:
    """Once: the graph of a study asks for the registry tens of thousands of times."""
    package = importlib.import_module("heartfit.mechanisms")
    for module in pkgutil.iter_modules(package.__path__):
        importlib.import_module(f"heartfit.mechanisms.{module.name}")

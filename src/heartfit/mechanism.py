"""Mechanisms: physical effects that are added to a heart, each in the role that fixes where it enters.

A mechanism is one frozen dataclass in one file of ``heartfit/mechanisms``; it declares its parameters
(:mod:`heartfit.parameter`), exactly one of which has an ``off`` value at which the effect vanishes. The folder
is the registry: a file dropped there is a candidate everywhere.
"""

import importlib
import pkgutil
from abc import ABC, abstractmethod
from dataclasses import replace
from typing import ClassVar, Self, TypeVar

import numpy as np

from heartfit.branch import Branch
from heartfit.geometry.arrays import Floats
from heartfit.parameter import Parameter, parameters_of

COMPARTMENTS = ("lv", "rv", "aorta", "pulmonary_artery", "left_atrium", "right_atrium")


class Mechanism(ABC):  # noqa: B024
    """What every mechanism offers, whatever its role."""

    @classmethod
    def switch(cls) -> Parameter:
        """The one parameter that turns the mechanism off; ``TypeError`` if there is not exactly one."""
        switches = [declared for declared in parameters_of(cls) if declared.off is not None]
        if len(switches) != 1:
            raise TypeError(
                f"{cls.__name__} declares {len(switches)} parameters with an off value: expected one"
            )
        return switches[0]

    def turned_off(self) -> Self:
        """The same mechanism at its off value."""
        return replace(self, **{self.switch().name: self.switch().off})  # type: ignore[type-var]


class Flow(Mechanism):
    """A branch of the circuit from ``upstream`` to ``downstream``."""

    upstream: ClassVar[str]
    downstream: ClassVar[str]

    @abstractmethod
    def law(self, time: Floats) -> Branch:
        """The branch at ``time``, s (any shape): its coefficients are numbers or of that shape."""

    def flow(self, time: float, drop: float) -> tuple[float, float]:
        """Flow, m^3/s, at the pressure drop upstream - downstream, Pa, and its derivative by the drop."""
        return self.law(np.asarray(time)).flow(drop)


class Pressure(Mechanism):
    """A pressure added to that of prescribed compartments."""

    @abstractmethod
    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:
        """Pressure added to ``compartment`` at ``time`` (any shape), Pa; periodic in ``period``."""


class Sensor(Mechanism):
    """What an instrument makes of a curve: it enters the measurement, and the heart does not feel it.

    Several sensors act one after the other, in the order in which they were added to the heart.
    """

    measures: ClassVar[tuple[str, ...]]
    """Names of the curves that it measures, as :meth:`heartfit.beat.Beat.signals` gives them."""

    @abstractmethod
    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        """What it shows (t,) of the periodic curve ``values`` (t,), SI, at ``times`` (t,), s after the trigger."""


ROLES: tuple[type[Mechanism], ...] = (Flow, Pressure, Sensor)

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
    package = importlib.import_module("heartfit.mechanisms")
    for module in pkgutil.iter_modules(package.__path__):
        importlib.import_module(f"heartfit.mechanisms.{module.name}")
    return dict(sorted(_REGISTRY.items()))

"""Requirements of a role: fields, attributes and methods of a mechanism, checked as its class is defined."""

from collections.abc import Iterable

from heartfit.roles.interfaces import (
    COMPARTMENTS,
    Amendment,
    Chamber,
    Flow,
    Mechanism,
    Narrowing,
    Pressure,
    Sensor,
    Stress,
)
from heartfit.roles.sides import VALVES

ATRIA = COMPARTMENTS[4:]
WITH_PRESSURE = COMPARTMENTS[2:]
"""Compartments to whose pressure a mechanism may add; that of a ventricle follows from its wall."""

NAMED: tuple[tuple[type[Mechanism], str, tuple[str, ...]], ...] = (
    (Flow, "upstream", COMPARTMENTS),
    (Flow, "downstream", COMPARTMENTS),
    (Narrowing, "valve", tuple(VALVES)),
    (Pressure, "compartments", WITH_PRESSURE),
    (Chamber, "compartment", ATRIA),
    (Stress, "acts_on", ("wall", "fibre")),
    (Amendment, "amends", ()),
    (Sensor, "measures", ()),
)
"""Role, attribute of the class that it needs, and the names that may stand there; any name where none are listed."""

SEVERAL = ("compartments", "measures")
"""Attributes that are tuples of names."""


def require_complete(cls: type[Mechanism]) -> None:
    """Raise TypeError unless a class has the fields, the attributes and the methods of its role, and one switch."""
    if "__dataclass_params__" not in vars(cls):
        raise TypeError(
            f"{cls.__name__} is no dataclass: write @dataclass(frozen=True) between @mechanism and class"
        )
    cls.switch()
    if missing := sorted(cls.__abstractmethods__):
        raise TypeError(f"{cls.__name__} lacks {' and '.join(f'{name}()' for name in missing)}: define it")
    for role, attribute, known in NAMED:
        if issubclass(cls, role):
            _require_names(cls, attribute, known)


def _require_names(cls: type[Mechanism], attribute: str, known: tuple[str, ...]) -> None:
    stated = getattr(cls, attribute, None)
    if stated is None:
        expected = f"; expected {_of(known)}" if known else ""
        raise TypeError(f"{cls.__name__} states no {attribute}{expected}: add it to the class")
    if attribute in SEVERAL and isinstance(stated, str):
        raise TypeError(f"{cls.__name__}.{attribute} = {stated!r}; expected a tuple: write ({stated!r},)")
    names = (stated,) if isinstance(stated, str) else stated
    unknown = [name for name in names if known and name not in known]
    if unknown:
        raise TypeError(
            f"{cls.__name__}.{attribute} = {stated!r}: {', '.join(map(repr, unknown))} is unknown; expected "
            f"{_of(known)}: correct it"
        )


def _of(known: Iterable[str]) -> str:
    return f"one of {', '.join(known)}"

"""Declarations of physical parameters, and the units in which tables and figures print them.

A part is a frozen dataclass; each of its parameters is declared with value, unit, symbol, meaning and, if
it may be calibrated, the relative standard deviation of its prior. Tables, schema and documentation are read
from these declarations. All computation is in SI.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, fields, replace
from functools import cache
from math import exp, inf
from typing import Any

from heartfit.core.errors import InputError

LARGEST = {"m": 10.0, "m^2": 1e-2, "m^3": 1e-2, "s": 60.0}
"""Largest value of a parameter by its SI unit, unless it declares another: no part of a heart is 10 m long, no
valve has 100 cm^2, no cavity 10 L, and no time of a beat lasts a minute. A larger number is in mm, cm^2, mL or ms."""


@dataclass(frozen=True)
class Parameter:
    """Declaration of one parameter: SI ``value``, ``unit``, LaTeX ``symbol``, ``meaning``.

    ``sd`` is the relative standard deviation of its log-normal prior (``None``: never calibrated), ``off`` the
    value at which a mechanism vanishes, ``low`` and ``high`` the bounds outside of which the value makes no sense.
    ``scale``, in ``unit``, is the standard deviation that a search for causes gives a parameter instead: normal about
    ``off`` where it has one, about ``value`` otherwise, and half-normal where nothing below ``off`` makes sense.
    """

    name: str
    value: float
    unit: str
    symbol: str
    meaning: str
    sd: float | None = None
    off: float | None = None
    low: float = 0.0
    scale: float | None = None
    high: float = inf

    @property
    def one_sided(self) -> bool:
        """True for a switch whose sign is fixed: no value below ``off`` makes sense."""
        return self.off is not None and self.low >= self.off

    def at(self, x: float) -> float:
        r"""Return the value ``x`` standard deviations of the search's prior from its centre, never below ``low``.

        .. math:: \theta = \theta_0 + s x \text{ with a scale } s, \qquad
                  \theta = \theta_0 e^{\mathrm{sd}\, x} \text{ otherwise.}

        Raises ``InputError`` if neither is declared.
        """
        if self.scale is not None:
            return max(self.low, (self.value if self.off is None else self.off) + self.scale * x)
        if self.sd is None:
            raise InputError(f"parameter {self.name} cannot be searched: declare its scale or its sd")
        return self.value * exp(self.sd * x)


def parameter(
    value: float,
    *,
    unit: str,
    symbol: str,
    meaning: str,
    sd: float | None = None,
    off: float | None = None,
    low: float = 0.0,
    scale: float | None = None,
    high: float | None = None,
) -> Any:
    """Return a dataclass field that declares a parameter; see :class:`Parameter`.

    ``high`` is that of ``LARGEST`` for the unit if None.
    """
    description = {"unit": unit, "symbol": symbol, "meaning": meaning}
    prior = {"sd": sd, "off": off, "low": low, "scale": scale}
    prior["high"] = LARGEST.get(unit, inf) if high is None else high
    return field(default=value, metadata={"parameter": description | prior})


def redeclared(part: type, name: str, value: float, **changes: Any) -> Any:
    """Return a dataclass field that declares the parameter ``name`` of a base class anew for a subclass.

    It has its own ``value`` and keeps all else but the ``changes``; see :class:`Parameter`.
    """
    (base,) = (entry for entry in fields(part) if entry.name == name)
    return field(default=value, metadata={"parameter": base.metadata["parameter"] | changes})


def parameters_of(part: Any) -> Iterator[Parameter]:
    """Yield the parameters that a part (class or instance) declares, with the values of the instance."""
    kind: Any = part if isinstance(part, type) else type(part)
    for declared in _declarations(kind):
        yield declared if kind is part else replace(declared, value=getattr(part, declared.name))


def parameter_values(part: Any) -> Iterator[tuple[str, float]]:
    """Yield name and value of every parameter of an instance."""
    kind: Any = type(part)
    return ((declared.name, getattr(part, declared.name)) for declared in _declarations(kind))


@cache
def _declarations(kind: Any) -> tuple[Parameter, ...]:
    """Return the declarations of a class; cached, because a search reads them thousands of times."""
    entries: list[Any] = [entry for entry in fields(kind) if "parameter" in entry.metadata]
    return tuple(
        Parameter(name=entry.name, value=entry.default, **entry.metadata["parameter"]) for entry in entries
    )


def require_admissible(part: Any) -> None:
    """Raise ``InputError`` unless every parameter of ``part`` is finite and within its bounds."""
    kind: Any = type(part)
    for declared in _declarations(kind):
        value = getattr(part, declared.name)
        try:
            admissible = declared.low <= value < float("inf")
        except TypeError:
            raise InputError(
                f"{type(part).__name__}.{declared.name} = {value!r}: expected a number in {declared.unit} "
                f"({declared.meaning})"
            ) from None
        if not admissible:
            raise InputError(
                f"{type(part).__name__}.{declared.name} = {value:g} {declared.unit}: expected a finite "
                f"value of at least {declared.low:g} ({declared.meaning})"
            )
        if value > declared.high:
            raise InputError(
                f"{type(part).__name__}.{declared.name} = {value:g} {declared.unit}: expected at most "
                f"{declared.high:g} {declared.unit} ({declared.meaning}): convert it to {declared.unit}"
            )


DISPLAY = {  # SI unit: printed unit, SI value of one printed unit
    "Pa": ("kPa", 1e3),
    "Pa.s": ("kPa.s", 1e3),
    "Pa.s/m^3": ("MPa.s/m^3", 1e6),
    "MPa.s/m^3": ("MPa.s/m^3", 1.0),
    "MPa": ("kPa", 1e-3),
    "MPa.s": ("kPa.s", 1e-3),  # units of the paper
    "m^3": ("mL", 1e-6),
    "m^3/s": ("mL/s", 1e-6),
    "Pa/s": ("kPa/s", 1e3),
}


def to_printed_unit(value: float, unit: str) -> float:
    """Convert a value from `unit` to its printed unit."""
    return value / DISPLAY.get(unit, (unit, 1.0))[1]


def printed_unit(unit: str) -> str:
    """Return the unit in which a quantity given in `unit` is printed."""
    return DISPLAY.get(unit, (unit, 1.0))[0]


def column_heading(name: str, unit: str) -> str:
    """Return the column heading of a quantity given in `unit`, such as "sigma_0 (kPa)"."""
    return f"{name} ({printed_unit(unit)})"

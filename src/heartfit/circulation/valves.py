r"""Valve laws: flow through a valve as a function of the pressure drop across it.

A law maps the drop :math:`\Delta p` to :math:`(q, dq/d\Delta p)`; it increases with the drop, so that each
time step of the circuit has one solution.
"""

from dataclasses import dataclass
from math import sqrt
from typing import Protocol

from heartfit.parameter import parameter, require_admissible

BLOOD_DENSITY = 1060.0
"""kg/m^3"""

SMOOTHING = 20.0
"""Pressure drop, Pa, below which the orifice law is linear: the square root has no slope at zero."""


class Valve(Protocol):
    """What the circuit asks of a valve."""

    def flow(self, drop: float) -> tuple[float, float]:
        """Flow, m^3/s, and its derivative by the drop, m^3/(s Pa)."""


@dataclass(frozen=True)
class LinearValve:
    r"""Piecewise linear valve: :math:`q = K_o \Delta p` open, :math:`q = K_c \Delta p` closed.

    Source: Sainte-Marie et al., Computers and Structures 84 (2006), the valve law of the paper's reference 4.
    """

    open: float = parameter(4e-6, unit="m^3/(s.Pa)", symbol="K_o", meaning="conductance of the open valve")
    closed: float = parameter(
        1e-11, unit="m^3/(s.Pa)", symbol="K_c", meaning="conductance of the closed valve"
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def flow(self, drop: float) -> tuple[float, float]:
        conductance = self.open if drop > 0.0 else self.closed
        return conductance * drop, conductance


@dataclass(frozen=True)
class OrificeValve:
    r"""Bernoulli's valve: :math:`q = A \sqrt{2 \Delta p/\rho}` open, a small linear leak closed."""

    area: float = parameter(4e-4, unit="m^2", symbol="A", meaning="effective orifice area of the open valve")
    closed: float = parameter(
        1e-11, unit="m^3/(s.Pa)", symbol="K_c", meaning="conductance of the closed valve"
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def flow(self, drop: float) -> tuple[float, float]:
        return orifice_flow(self.area, drop) if drop > 0.0 else (self.closed * drop, self.closed)


def orifice_flow(area: float, drop: float) -> tuple[float, float]:
    r"""Flow and slope of :math:`q = A \sqrt{2/\rho}\, \Delta p\, (\Delta p^2 + \epsilon^2)^{-1/4}`.

    The root is smoothed over :math:`\epsilon` = 20 Pa; odd in the drop.
    """
    factor = area * sqrt(2.0 / BLOOD_DENSITY)
    smooth = drop * drop + SMOOTHING * SMOOTHING
    return factor * drop * smooth**-0.25, factor * smooth**-1.25 * (0.5 * drop * drop + SMOOTHING * SMOOTHING)

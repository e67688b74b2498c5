r"""Valve laws: flow through a valve as a function of the pressure drop across it.

A law maps the drop :math:`\Delta p` to :math:`(q, dq/d\Delta p)`; it increases with the drop, so that each
time step of the circuit has one solution. It is given as the coefficients of a branch.
"""

from dataclasses import dataclass
from typing import Protocol

from heartfit.branch import Branch
from heartfit.parameter import parameter, require_admissible


class Valve(Protocol):
    """What the circuit asks of a valve."""

    def law(self) -> Branch:
        """Flow as a function of the pressure drop."""


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

    def law(self) -> Branch:
        return Branch(conductance=self.open, back_conductance=self.closed)


@dataclass(frozen=True)
class OrificeValve:
    r"""Bernoulli's valve: :math:`q = A \sqrt{2 \Delta p/\rho}` open, a small linear leak closed."""

    area: float = parameter(4e-4, unit="m^2", symbol="A", meaning="effective orifice area of the open valve")
    closed: float = parameter(
        1e-11, unit="m^3/(s.Pa)", symbol="K_c", meaning="conductance of the closed valve"
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def law(self) -> Branch:
        return Branch(area=self.area, back_conductance=self.closed)

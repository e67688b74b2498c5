r"""Valves and arteries: linear valves, orifices and both in series, and the four-element Windkessel.

A valve law maps the pressure drop :math:`\Delta p` across the valve to :math:`(q, dq/d\Delta p)`; it increases with the
drop, so that every time step of the circuit has one solution. It is stated as the coefficients of a branch.

The Windkessel has an inertance parallel to the characteristic resistance, in series with R_p // C:

.. math:: C \dot P_c = q - \frac{P_c - P_{ve}}{R_p}, \quad L \dot q_L = Z_c (q - q_L), \quad
          P_{ar} = P_c + Z_c (q - q_L), \quad C = \tau / R_p

Backward Euler over a step, with :math:`\theta = \Delta t\, Z_c / L`, leaves the arterial pressure affine in
the inflow: :math:`P_{ar} = a + b q`.
Source: Stergiopulos, Westerhof and Westerhof, Am. J. Physiol. 276 (1999) H81.
"""

import math
from dataclasses import dataclass
from typing import Protocol

from numba import njit

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles.laws import Branch


class Valve(Protocol):
    """Interface of a valve."""

    def law(self) -> Branch:
        """Coefficients of the flow as a function of the pressure drop."""


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


@dataclass(frozen=True)
class SeriesValve(LinearValve):
    r"""Conductance in series with Bernoulli's orifice: :math:`\Delta p = q/K_o + \rho q^2 / (2 A^2)` open.

    The one loses by viscosity alone, the other by inertia alone; a real valve by both.
    """

    area: float = parameter(
        4e-4,
        unit="m^2",
        symbol="A",
        meaning="effective orifice area of the open valve",
        high=math.inf,  # of a valve that loses by viscosity alone
    )

    def law(self) -> Branch:
        return super().law().with_narrowing(self.area**-2)


EJECTION_TIME = 0.3
"""Time from the start of atrial systole to the middle of ejection [s]."""


@dataclass(frozen=True)
class WindkesselState:
    """Pressure of the compliance [Pa] and flow through the inertance [m^3/s]."""

    P_c: float
    q_L: float = 0.0


@dataclass(frozen=True)
class Windkessel:
    """Arterial tree of one side; the defaults are systemic."""

    R_p: float = parameter(1.05e8, unit="Pa.s/m^3", symbol="R_p", meaning="peripheral resistance", sd=0.20)
    tau: float = parameter(1.6, unit="s", symbol=r"\tau", meaning="characteristic time R_p C", sd=0.20)
    Z_c: float = parameter(7.5e6, unit="Pa.s/m^3", symbol="Z_c", meaning="characteristic resistance", sd=0.25)
    L: float = parameter(6e5, unit="Pa.s^2/m^3", symbol="L", meaning="total arterial inertance", sd=0.30)
    P_ve: float = parameter(1200.0, unit="Pa", symbol="P_{ve}", meaning="venous pressure")

    def __post_init__(self) -> None:
        require_admissible(self)

    def constants(self) -> tuple[float, ...]:
        return self.R_p, self.tau, self.Z_c, self.L, self.P_ve

    def affine_pressure(self, state: WindkesselState, dt: float) -> tuple[float, float]:
        """Coefficients (a, b) of the arterial pressure a + b q [Pa] after a step ``dt`` [s] with inflow q [m^3/s]."""
        a, b = affine_coefficients(*self.constants(), state.P_c, state.q_L, dt)  # type: ignore[call-arg]
        return a, b

    def advance(self, state: WindkesselState, inflow: float, dt: float) -> WindkesselState:
        """State after a step ``dt`` [s] with the inflow [m^3/s]."""
        return WindkesselState(*advance_windkessel(*self.constants(), state.P_c, state.q_L, inflow, dt))  # type: ignore[call-arg]

    def pressure_deficit(
        self, start: WindkesselState, end: WindkesselState, period: float, surplus: float = 0.0
    ) -> float:
        r"""Rise of P_c [Pa] at the start of a beat to the value that the inflow of equal beats would hold.

        Over a beat of length T the pressure decays by the factor :math:`a = e^{-T/\tau}`, so that the inflow holds
        :math:`P_c(0) + (P_c(T) - P_c(0)) / (1 - a)`, less the pressure held by the ``surplus`` [m^3] of the stroke of
        this beat over later ones.
        """
        return (end.P_c - start.P_c) / -math.expm1(-period / self.tau) - self._held_pressure(surplus, period)

    def periodic_start(self, stroke: float, period: float) -> WindkesselState:
        r"""State at the start of periodic beats that eject the ``stroke`` [m^3] at once at :math:`t_e` = EJECTION_TIME.

        .. math:: P_c = P_{ve} + \frac{V_s R_p}{\tau} \frac{e^{-(T - t_e)/\tau}}{1 - e^{-T/\tau}}
        """
        return WindkesselState(self.P_ve + self._held_pressure(stroke, period))

    def _held_pressure(self, stroke: float, period: float) -> float:
        """P_c - P_ve [Pa] at the start of periodic beats of the ``stroke`` volume [m^3]."""
        decayed = math.exp((EJECTION_TIME - period) / self.tau) / -math.expm1(-period / self.tau)
        return stroke * self.R_p / self.tau * decayed


@njit(cache=True, error_model="numpy")
def affine_coefficients(R_p, tau, Z_c, L, P_ve, P_c, q_L, dt):  # type: ignore[no-untyped-def]
    """:meth:`Windkessel.affine_pressure` as a compiled function."""
    rise, theta = dt * R_p / tau, dt * Z_c / L
    decay = 1.0 + dt / tau
    a = (P_c + rise * P_ve / R_p) / decay - Z_c * q_L / (1.0 + theta)
    return a, rise / decay + Z_c / (1.0 + theta)


@njit(cache=True, error_model="numpy")
def advance_windkessel(R_p, tau, Z_c, L, P_ve, P_c, q_L, inflow, dt):  # type: ignore[no-untyped-def]
    """P_c and q_L of :meth:`Windkessel.advance`."""
    rise, theta = dt * R_p / tau, dt * Z_c / L
    return (P_c + rise * (inflow + P_ve / R_p)) / (1.0 + dt / tau), (q_L + theta * inflow) / (1.0 + theta)


PULMONARY = Windkessel(R_p=1.5e7, tau=0.5, Z_c=2.5e6, L=1e5, P_ve=900.0)
"""Pulmonary circulation of a healthy adult, with the left atrium's mean pressure downstream."""

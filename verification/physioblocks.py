r"""Reference case of PhysioBlocks 2.0.1, a left ventricle with its authors' law, in our sphere.

Its passive law, series element, activation, valves with inertance, inertia of the wall and two-stage artery replace
the standard ones; the equations are those of BCS with

.. math:: W = C_0 e^{C_1 (2 C + C^{-2} - 3)^2} + C_2 e^{C_3 (C - 1)^2}, \qquad C = \Lambda^2 .

Source: PhysioBlocks (Inria; Drieu, Chapelle, Kimmig, Moireau), its shipped case spherical_heart_forward_sim.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter
from heartfit.heart.beat import Beat
from heartfit.heart.circulation.elements import LinearValve, Windkessel
from heartfit.heart.circulation.network import Circulation
from heartfit.heart.finite_elements.body import Tissue
from heartfit.heart.heart import Heart
from heartfit.heart.muscle.bcs import BestelClementSorine
from heartfit.heart.muscle.control import Control, Starling
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.heart import Inertia
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.roles import Pressure
from verification.check import Check

PERIOD, THEIR_STEP = 1.0, 1e-3
SPHERE = Sphere(radius=0.034, thickness=0.0113)
INERTIA = Inertia(density=1e3, valves=(("mitral", 1e3), ("aortic", 3e4)), arteries=2e-10)

ACTIVATION = np.array(
    [
        (0.0, -20.0),
        (0.027 * 15 / 13, -20.0),
        (0.037 * 15 / 13, 0.0),
        (0.037 * 15 / 13 + 0.108 * 20 / 19, 35.0),
        (0.037 * 15 / 13 + 0.272 * 20 / 19, 35.0),
        (0.037 * 15 / 13 + 0.380 * 20 / 19, 0.0),
        (0.047 * 15 / 13 + 0.380 * 20 / 19, -20.0),
        (PERIOD, -20.0),
    ]
)
"""Time, s, and u, 1/s, at the knots of the activation: diastole is stretched by 2/13, systole by 1/19."""

ATRIUM = np.array(
    [
        (0.0, 900.0),
        (0.02 * 15 / 13, 900.0),
        (0.07 * 15 / 13, 450.0),
        (0.07 * 15 / 13 + 0.85, 450.0),
        (PERIOD, 900.0),
    ]
)
"""Time, s, and atrial pressure, Pa, at its knots."""


@dataclass(frozen=True)
class TwoExponentials:
    """Passive law of the module in the wall of a sphere, with the viscosity ``eta``."""

    constants: tuple[float, float, float, float] = (444.0, 2.9, 69.0, 6.5)
    eta: float = 70.0

    def in_plane_stress(self, stretch: Floats, scale: Floats | float = 1.0) -> Floats:
        return scale * self._derivatives(stretch)[0]

    def in_plane_stiffness(self, stretch: Floats, scale: Floats | float = 1.0) -> Floats:
        return scale * self._derivatives(stretch)[1]

    def _derivatives(self, x: Floats) -> Floats:
        """First and second derivative (2, ...) of the energy by the stretch x."""
        isotropic = 2.0 * x**2 + x**-4 - 3.0, 4.0 * x - 4.0 * x**-5, 4.0 + 20.0 * x**-6
        along = x**2 - 1.0, 2.0 * x, np.full_like(x, 2.0)
        C_0, C_1, C_2, C_3 = self.constants
        return _exponential(C_0, C_1, *isotropic) + _exponential(C_2, C_3, *along)


def _exponential(size: float, growth: float, g: Floats, g_x: Floats, g_xx: Floats) -> Floats:
    """First and second derivative of size exp(growth g^2), given those of g."""
    factor = 2.0 * size * growth * np.exp(growth * g**2)
    return np.array([factor * g * g_x, factor * (g_x**2 + g * g_xx + 2.0 * growth * g**2 * g_x**2)])


@dataclass(frozen=True)
class Waveform(Control):
    """A piecewise linear u(t) with the given knots (k, 2), which include its zeros, advanced by ``ahead`` [s]."""

    knots: tuple[tuple[float, float], ...] = ()
    ahead: float = 0.0

    def mean(
        self, start: Floats | float, dt: float, activation: Floats, period: float
    ) -> tuple[Floats, Floats]:
        t, u = np.array(self.knots).T
        begin = np.asarray(start) + self.ahead - activation
        size, attach = (_mean(t, values, begin, dt, period) for values in (np.abs(u), np.maximum(u, 0.0)))
        return size, attach


def _mean(t: Floats, u: Floats, start: Floats, dt: float, period: float) -> Floats:
    """Mean over [start, start + dt] of the periodic piecewise linear function through (t, u)."""
    area = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(t) * (u[1:] + u[:-1]))])

    def integral(end: Floats) -> Floats:
        cycles, rest = np.divmod(end, period)
        k = np.clip(np.searchsorted(t, rest, side="right") - 1, 0, len(t) - 2)
        into, slope = rest - t[k], (u[k + 1] - u[k]) / (t[k + 1] - t[k])
        return cycles * area[-1] + area[k] + into * (u[k] + 0.5 * slope * into)

    return (integral(start + dt) - integral(start)) / dt


@dataclass(frozen=True)
class AtrialWave(Pressure):
    """Atrial pressure of the case, added to a resting pressure of 0 Pa."""

    compartments = ("left_atrium",)
    scale: float = parameter(1.0, unit="1", symbol="s", meaning="scale of the wave", off=0.0)

    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:
        share = self.scale if compartment in self.compartments else 0.0
        return share * np.interp(np.mod(time, period), *ATRIUM.T)


def reference_heart() -> Heart:
    """Heart of the case.

    PhysioBlocks evaluates u at the end of its steps of 1 ms, on average half a step early; so does this heart.
    """
    active = BestelClementSorine(
        sigma_0=90e3, k_0=273e3, alpha=12.0, mu=70.0, E_s=1e8, starling=Starling(1.0, 0.0), additive=True
    )
    control = Waveform(knots=tuple(map(tuple, ACTIVATION.tolist())), ahead=0.5 * THEIR_STEP)
    closed = 5e-12
    circulation = Circulation(
        systemic=Windkessel(R_p=1.1e8, tau=2.0, Z_c=7e6, L=1e30, P_ve=1600.0),
        mitral=LinearValve(9e-6, closed),
        aortic=LinearValve(1.3e-5, closed),
        left_atrium=0.0,
    )
    tissue = Tissue(passive=TwoExponentials(), active=active, control=control)  # type: ignore[arg-type]
    return Heart(tissue, circulation, (AtrialWave(),), PERIOD)


def reference_beat(beats: int = 10, drift: float = 1e-4, inertia: Inertia = INERTIA) -> Beat:
    """Beat of the case on its limit cycle, or the last of ``beats``, with the step of PhysioBlocks."""
    numerics = Numerics(time_step=THEIR_STEP, max_beats=beats, drift=drift)
    return simulate_spheres(reference_heart(), [SPHERE], numerics, np.zeros(1), inertia)


def departure(measured: Floats, reference: Floats) -> float:
    """L2 distance of two curves over the norm of the reference less its mean."""
    return float(np.linalg.norm(measured - reference) / np.linalg.norm(reference - reference.mean()))


MILLILITRE, MMHG = 1e-6, 133.322
PUBLISHED = {
    "largest volume": (182.971, "mL"),
    "smallest volume": (79.931, "mL"),
    "largest pressure": (124.930, "mmHg"),
    "dV/dt max": (901.7, "mL/s"),
    "dV/dt min": (-625.0, "mL/s"),
    "dP/dt max": (1778.0, "mmHg/s"),
    "dP/dt min": (-1929.0, "mmHg/s"),
}
"""Extremes of the tenth beat of its example spherical_heart_forward_sim, unchanged, run with version 2.0.1 at 1 ms."""


def physioblocks_checks() -> list[Check]:
    """Check each extreme to 2 %."""
    beat = reference_beat()
    V, P = beat.volume["lv"] / MILLILITRE, beat.pressure["lv"] / MMHG
    q, dP = np.gradient(V, beat.time), np.gradient(P, beat.time)
    extremes = V.max(), V.min(), P.max(), q.max(), q.min(), dP.max(), dP.min()
    return [
        Check(f"sphere: {name}", float(value), expected, 0.02 * abs(expected), unit, "PhysioBlocks 2.0.1")
        for value, (name, (expected, unit)) in zip(extremes, PUBLISHED.items(), strict=True)
    ]

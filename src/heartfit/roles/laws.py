r"""Laws of circuit branches and of outside loads, as coefficients that Python and compiled beats share.

A branch of the circuit has the flow

.. math:: q(\Delta p) = K \Delta p + A \sqrt{2/\rho}\, \Delta p\, (\Delta p^2 + \epsilon^2)^{-1/4} + q_0,

a conductance K in parallel with an orifice of area A, each with one value for forward (:math:`\Delta p > 0`) and one
for backward flow, and a source that no pressure drives. The orifice is Bernoulli's, its root smoothed over
:math:`\epsilon` = 20 Pa. A narrowing in series takes :math:`b q^2` of the forward drop, which leaves a conductance

.. math:: q = \frac{2 K \Delta p}{1 + \sqrt{1 + 4 b K^2 \Delta p}}

and a smaller orifice. Valves and leaks are such branches.

A valve may have leaflets that take time to move. Its opening :math:`\zeta`, 0 to 1, follows the pressure drop (Mynard
et al. 2012),

.. math:: \dot\zeta = \begin{cases} K_o (1 - \zeta)\, \Delta p & \Delta p > 0 \\
                                   K_c\, \zeta\, \Delta p & \Delta p < 0, \end{cases}

and it passes :math:`\zeta f(\Delta p)` in both directions, f being its forward law, in addition to its backward law.
With the inertance L of the blood in it, :math:`q = \zeta f(\Delta p - L \dot q)`. For :math:`K_o, K_c \to \infty` and L
= 0 it is the valve without leaflets.

A load is a pressure on the outside of a ventricle,

.. math:: p(\bar V) = p_0 + a\, e^{(\bar V - V_0) / v}

with :math:`\bar V` the mean volume of the ventricles that beat side by side; a single ventricle takes its own. A wall
that keeps its volume transmits the outside pressure to its cavity unchanged.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError

BLOOD_DENSITY = 1060.0
"""Density of blood [kg/m^3]."""

SMOOTHING = 20.0
"""Pressure drop [Pa] below which the orifice law is linear: the slope of the square root is infinite at zero."""


class Branch(NamedTuple):
    """Coefficients of a branch: conductances [m^3/(s Pa)] and orifice areas [m^2], forward and backward.

    ``loss`` [Pa s^2/m^6] is the b of a narrowing in series with the forward conductance, ``source`` [m^3/s] a flow
    that no pressure drives. Each is a number, or an array over times.
    """

    conductance: float | Floats = 0.0
    area: float | Floats = 0.0
    back_conductance: float | Floats = 0.0
    back_area: float | Floats = 0.0
    loss: float | Floats = 0.0
    source: float | Floats = 0.0

    def flow(self, drop: float) -> tuple[float, float]:
        """Flow [m^3/s] at the pressure drop [Pa], and its derivative by the drop."""
        flow, slope = branch_flow(np.array([[self]]), 0, 0, drop)
        return float(flow), float(slope)

    def with_narrowing(self, inverse_square: float) -> "Branch":
        r"""Return the branch in series with a narrowing of area B, :math:`a = 1/B^2` [1/m^4].

        Bernoulli's losses add: :math:`b = \rho a / 2`, and :math:`1/A'^2 = 1/A^2 + a` of an orifice. Raises InputError
        for a conductance in parallel with an orifice: the two in series with a narrowing have no closed form.
        """
        if np.any(self.conductance) and np.any(self.area):
            raise InputError(
                "branch: a conductance in parallel with an orifice cannot be narrowed; expected one of them"
            )
        area = self.area / np.sqrt(1.0 + inverse_square * np.square(self.area))
        return self._replace(area=area, loss=self.loss + 0.5 * BLOOD_DENSITY * inverse_square)


@njit(cache=True, error_model="numpy", inline="always")
def branch_flow(laws, t, k, drop):  # type: ignore[no-untyped-def]
    """Flow and slope of branch k at time t of the ``laws`` (.., .., 6); does not fall with the drop."""
    way = 0 if drop > 0.0 else 2
    conductance, area = laws[t, k, way], laws[t, k, way + 1]
    flow, slope = conductance * drop, conductance
    if drop > 0.0 and laws[t, k, 4] != 0.0:
        root = np.sqrt(1.0 + 4.0 * laws[t, k, 4] * conductance * flow)
        flow, slope = 2.0 * flow / (1.0 + root), slope / root
    if area != 0.0:
        factor = area * np.sqrt(2.0 / BLOOD_DENSITY)
        smooth = drop * drop + SMOOTHING * SMOOTHING
        root = factor / np.sqrt(np.sqrt(smooth))
        flow += root * drop
        slope += root * (0.5 * drop * drop + SMOOTHING * SMOOTHING) / smooth
    return flow + laws[t, k, 5], slope


class Leaflets(NamedTuple):
    """Inertance [Pa s^2/m^3] of the blood in a valve, and rates of opening and of closing [1/(Pa s)].

    Rates of zero stand for leaflets without delay.
    """

    inertance: float = 0.0
    opening: float = 0.0
    closing: float = 0.0


INERTIA, OPENING_RATE, CLOSING_RATE, START_FLOW, START_OPENING, FLOW, OPENING = range(7)
"""Rows of the states of branches in a step of effective length w: L/w, w K_o and w K_c, starting values of flow and
opening, and the flow and the opening at its end."""

STATE_ROWS = 7


@njit(cache=True, error_model="numpy")
def opening_at(drop, start, opening, closing):  # type: ignore[no-untyped-def]
    """Opening of a valve at the end of a step with the pressure drop, and its derivative by the drop.

    ``start`` is the opening at the start of the step; ``opening`` and ``closing`` are the rates times its length,
    1/Pa.
    """
    if drop > 0.0:
        per = 1.0 / (1.0 + opening * drop)
        return (start + opening * drop) * per, opening * (1.0 - start) * per * per
    per = 1.0 / (1.0 - closing * drop)
    return start * per, closing * start * per * per


NO_LEAFLETS = -1.0
"""Opening of a valve without leaflets: the sign of its pressure drop opens and closes it."""


@njit(cache=True, error_model="numpy")
def leaflet_flow(laws, t, k, drop, zeta):  # type: ignore[no-untyped-def]
    """Flow of branch k at the opening ``zeta``, and its derivatives by the drop and by the opening."""
    if drop >= 0.0:
        flow, slope = branch_flow(laws, t, k, drop)
        return zeta * flow, zeta * slope, flow
    flow, slope = branch_flow(laws, t, k, -drop)
    leak, leak_slope = branch_flow(laws, t, k, drop)
    return leak - zeta * flow, leak_slope + zeta * slope, -flow


@njit(cache=True, error_model="numpy", inline="always")
def instant_flow(laws, t, k, drop, zeta):  # type: ignore[no-untyped-def]
    """Flow of branch k without inertance, and its derivatives by drop and opening; ``zeta`` may be NO_LEAFLETS."""
    if zeta == NO_LEAFLETS:
        flow, slope = branch_flow(laws, t, k, drop)
        return flow, slope, 0.0
    return leaflet_flow(laws, t, k, drop, zeta)


FLOW_TOLERANCE, MAX_ITERATIONS = 1e-14, 60
"""Relative change of an inertial flow at which its equation is solved, and largest number of iterations."""


@njit(cache=True, error_model="numpy", inline="always")
def inertial_flow(laws, t, k, drop, zeta, inertance, before):  # type: ignore[no-untyped-def]
    r"""Flow at the end of a step of length w, :math:`q = f_\zeta(\Delta p - L \dot q)`, and its derivatives.

    These are by the drop and by the opening ``zeta``, which may be NO_LEAFLETS. ``inertance`` is L/w [Pa s/m^3],
    ``before`` the flow :math:`q^*` with :math:`\dot q = (q - q^*)/w`. Solved by Newton's method between bounds.
    """
    if inertance == 0.0:
        return instant_flow(laws, t, k, drop, zeta)
    driving, slope, rise = drop + inertance * before, 0.0, 0.0
    q, low, high = 0.0, min(0.0, driving / inertance), max(0.0, driving / inertance)
    for _ in range(MAX_ITERATIONS):
        flow, slope, rise = instant_flow(laws, t, k, driving - inertance * q, zeta)
        if flow > q:
            low = q
        else:
            high = q
        following = q + (flow - q) / (1.0 + inertance * slope)
        if not low <= following <= high:
            following = 0.5 * (low + high)
        change, q = following - q, following
        if abs(change) <= FLOW_TOLERANCE * abs(q):
            break
    return q, slope / (1.0 + inertance * slope), rise / (1.0 + inertance * slope)


@njit(cache=True, error_model="numpy", inline="always")
def advance_branch(laws, t, k, drop, states):  # type: ignore[no-untyped-def]
    """Flow of branch k at the end of a step, and its derivative by the drop; fills its rows FLOW and OPENING."""
    zeta, move, closing = NO_LEAFLETS, 0.0, states[CLOSING_RATE, k]
    if closing != 0.0:
        zeta, move = opening_at(drop, states[START_OPENING, k], states[OPENING_RATE, k], closing)
        states[OPENING, k] = zeta
    inertance, before = states[INERTIA, k], states[START_FLOW, k]
    flow, slope, rise = inertial_flow(laws, t, k, drop, zeta, inertance, before)
    states[FLOW, k] = flow
    return flow, slope + rise * move


class Load(NamedTuple):
    """Coefficients ``pulse`` p_0, ``rise`` a [Pa], ``volume`` V_0, ``scale`` v [m^3]: numbers, or arrays over times."""

    pulse: float | Floats = 0.0
    rise: float | Floats = 0.0
    volume: float | Floats = 0.0
    scale: float | Floats = 1.0


@njit(cache=True, error_model="numpy", inline="always")
def outside_pressure(loads, t, v, mean):  # type: ignore[no-untyped-def]
    """Sum of the ``loads`` (.., k, v, 4) on ventricle v at time t [Pa], and its derivative by the mean volume [m^3]."""
    pressure, slope = 0.0, 0.0
    for k in range(loads.shape[1]):
        rise, scale = loads[t, k, v, 1], loads[t, k, v, 3]
        if rise != 0.0:
            rise *= np.exp((mean - loads[t, k, v, 2]) / scale)
        pressure += loads[t, k, v, 0] + rise
        slope += rise / scale
    return pressure, slope

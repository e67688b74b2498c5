r"""Equations of atria with a volume, and of the veins that fill them, in one step of the circuit.

The pressures of both atria join the unknowns of :mod:`heartfit.heart.circulation.circuit` as soon as one of them has a
volume. With the law of :mod:`heartfit.roles.chamber`, its inverse x(P) at the end of the step, the effective length w
and the net outflow q through the valves,

.. math:: x(P) - \kappa (V_v - V_{ref}) - V^* + w\, q - w\, q_v = 0 .

Veins are linear and add no unknown: with the Windkessel that fills them their pressure is
:math:`P_v = \alpha + \beta q_{ar} + \gamma P`, and the arterial pressure becomes :math:`a + b q_{ar} + c P`. An atrium
without a volume next to one that has it keeps its prescribed pressure, :math:`P - P_{pre} = 0`. Where no atrium has a
volume the table of atria is None, which removes these equations from the compiled functions.
"""

from collections.abc import Sequence

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.heart.circulation.system import (
    CONSTANT,
    ONE_KILOPASCAL,
    ONE_MILLILITRE,
    REFERENCE,
    STORAGE,
    WEIGHT,
)
from heartfit.roles import COMPARTMENTS, Chamber, Mechanism
from heartfit.roles.chamber import (
    ATRIUM_ROWS,
    BALANCE,
    DESCENT,
    OUTSIDE,
    PRESSURE,
    RESERVOIR,
    RESISTANCE,
    START_VEIN,
    START_VOLUME,
    TREE,
    TREE_PER_INFLOW,
    TREE_PER_PRESSURE,
    VEIN,
    VEIN_END,
    VEIN_PER_INFLOW,
    VEIN_PER_PRESSURE,
    VEINS,
    VENTRICLE,
    VOLUME,
    stretched_volume,
)


def chamber_table(mechanisms: Sequence[Mechanism], sides: int = 2) -> Floats | None:
    """Table (ATRIUM_ROWS, sides) of the atria, None if none has a volume.

    Raises InputError for veins with an elastance with a single ventricle, whose circuit does not include their
    arteries.
    """
    table = np.zeros((ATRIUM_ROWS, sides))
    for chamber in (m for m in mechanisms if isinstance(m, Chamber)):
        side, law = COMPARTMENTS.index(chamber.compartment) - 4, chamber.atrium()
        if side < sides and law.resistance > 0.0:
            table[: len(law), side] = law
            if law.veins and sides == 1:
                raise InputError(
                    f"{type(chamber).__name__}: veins of elastance {law.veins:g} Pa/m^3 are filled by arteries of "
                    "the other side; expected both ventricles: add the right one or set the elastance to 0"
                )
    return table if table[RESISTANCE].any() else None


def sides_with_volume(atria: Floats | None) -> list[int]:
    """Sides of the atria that have a volume."""
    return [] if atria is None else np.flatnonzero(atria[RESISTANCE]).tolist()


def sides_filling_veins(atria: Floats | None) -> list[int]:
    """Sides of the arteries that fill veins, those of the other side."""
    return [] if atria is None else np.flatnonzero(atria[VEINS, ::-1]).tolist()


def fill_atria(atria: Floats, pressures: Floats, ventricles: Floats) -> None:
    """Set volumes and veins of relaxed atria at the resting ``pressures``, given the ``ventricles`` (v,) [m^3]."""
    for s in range(atria.shape[1]):
        atria[PRESSURE, s], atria[VEIN_END, s] = pressures[s], atria[RESERVOIR, s]
        if atria[RESISTANCE, s]:
            x, _ = stretched_volume(atria, s, pressures[s])
            atria[VOLUME, s] = x - atria[DESCENT, s] * (ventricles[s] - atria[VENTRICLE, s])


@njit(cache=True, error_model="numpy", inline="always")
def drain_arteries(atria, u, w, R_p, tau, P_c, a, b, wave):  # type: ignore[no-untyped-def]
    r"""Coefficients (a, b, c) of the pressure :math:`a + b q + c P` of the arteries u that fill veins.

    ``a`` and ``b`` are those of the Windkessel, which drains to its own venous pressure where the veins of the other
    side are a reservoir, and otherwise to zero plus the pressure of the veins. Fills the rows of the vein and of its
    arteries, whose pressure includes the ``wave`` [Pa].
    """
    s, c = 1 - u, 0.0
    if atria is not None and atria.shape[1] == 2 and atria[VEINS, s] > 0.0:
        decay, rise = 1.0 + w / tau, w * R_p / tau
        fill, empty = w * atria[VEINS, s] / (R_p * decay), w * atria[VEINS, s] / atria[RESISTANCE, s]
        per = 1.0 / (1.0 + empty + fill)
        atria[VEIN, s] = per * (atria[START_VEIN, s] + fill * P_c)
        atria[VEIN_PER_INFLOW, s] = per * fill * rise
        atria[VEIN_PER_PRESSURE, s] = per * empty
        back = w / tau / decay
        a, b = a + back * atria[VEIN, s], b + back * atria[VEIN_PER_INFLOW, s]
        c = back * atria[VEIN_PER_PRESSURE, s]
        atria[TREE, s], atria[TREE_PER_INFLOW, s], atria[TREE_PER_PRESSURE, s] = a + wave, b, c
    return a, b, c


@njit(cache=True, error_model="numpy", inline="always")
def begin_atria(atria, w, prescribed, t, system):  # type: ignore[no-untyped-def]
    """Set the equations of the atria in the ``system`` of the circuit, below those of the arteries.

    ``prescribed`` (t, v) are the pressures of atria without a volume, of which row t applies.
    """
    v = atria.shape[1]
    for s in range(v):
        i = 2 * v + s
        for j in range(system.shape[1]):
            system[i, j] = 0.0
        if atria[RESISTANCE, s] == 0.0:
            system[i, REFERENCE], system[i, STORAGE + i] = prescribed[t, s], 1.0 / ONE_KILOPASCAL
            continue
        entered, held = w / atria[RESISTANCE, s], 1.0
        source = atria[RESERVOIR, s]
        if atria[VEINS, s] > 0.0:
            u = v + 1 - s
            gain = atria[VEIN_PER_INFLOW, s] / atria[TREE_PER_INFLOW, s]
            source = atria[VEIN, s] + gain * (system[u, REFERENCE] - atria[TREE, s])
            held += gain * atria[TREE_PER_PRESSURE, s] - atria[VEIN_PER_PRESSURE, s]
            system[i, STORAGE + u] = -entered * gain / ONE_MILLILITRE
        system[i, WEIGHT], system[i, STORAGE + i] = w / ONE_MILLILITRE, entered * held / ONE_MILLILITRE
        atria[BALANCE, s] = -atria[START_VOLUME, s] - entered * source
        system[i, CONSTANT] = atria[BALANCE, s] / ONE_MILLILITRE


@njit(cache=True, error_model="numpy", inline="always")
def descend_planes(atria, s, volume, system):  # type: ignore[no-untyped-def]
    """Add the descent of the valve plane of a ventricle with the ``volume`` [m^3] at the references of the system."""
    v = atria.shape[1]
    share = atria[DESCENT, s]
    if share != 0.0:
        change = atria[BALANCE, s] - share * (volume - atria[VENTRICLE, s])
        system[2 * v + s, CONSTANT] = change / ONE_MILLILITRE
        for j in range(v):
            system[2 * v + s, STORAGE + j] = -share * system[s, STORAGE + j]


@njit(cache=True, error_model="numpy", inline="always")
def store_blood(atria, i, p):  # type: ignore[no-untyped-def]
    """Stored blood x(P) [mL] of the unknown i, and its derivative by the pressure; zero where there is no law."""
    s = i - 2 * atria.shape[1]
    if s < 0 or atria[RESISTANCE, s] == 0.0:
        return 0.0, 0.0
    x, slope = stretched_volume(atria, s, p - atria[OUTSIDE, s])
    return x / ONE_MILLILITRE, slope / ONE_MILLILITRE


@njit(cache=True, error_model="numpy", inline="always")
def end_atrium(atria, s, w, inflow, outflow, pressure):  # type: ignore[no-untyped-def]
    """Set volume, pressure and vein of atrium s at the end of a step with the ``inflow`` of the arteries of its veins.

    The volume follows from the flows, not from the pressure, so that blood is conserved to rounding.
    """
    atria[PRESSURE, s] = pressure
    if atria[RESISTANCE, s] > 0.0:
        vein = atria[RESERVOIR, s]
        if atria[VEINS, s] > 0.0:
            vein = (
                atria[VEIN, s] + atria[VEIN_PER_INFLOW, s] * inflow + atria[VEIN_PER_PRESSURE, s] * pressure
            )
        entered = (vein - pressure) / atria[RESISTANCE, s]
        atria[VOLUME, s] = atria[START_VOLUME, s] + w * (entered - outflow)
        atria[VEIN_END, s] = vein

"""Valves with inertance and leaflets that take time to move: closed forms, orders, limits and slopes."""

from itertools import product

import numpy as np
import pytest

from heartfit.core.parameter import parameters_of
from heartfit.heart.circulation.network import Network
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.heart.sphere.body import SphericalBody
from heartfit.roles import Dynamics, ValveDynamics, registered
from heartfit.roles.laws import (
    BLOOD_DENSITY,
    CLOSING_RATE,
    FLOW,
    INERTIA,
    OPENING,
    OPENING_RATE,
    START_FLOW,
    START_OPENING,
    STATE_ROWS,
    Branch,
    advance_branch,
    branch_flow,
)
from heartfit.roles.sides import VALVES
from tests.shrinking import assert_derivative
from verification.audit import lost_blood
from verification.audit_checks import TIGHT

LINEAR = Branch(conductance=4e-6, back_conductance=1e-11)
ORIFICE = Branch(area=4e-4, back_conductance=1e-11)
NARROWED = LINEAR.with_narrowing(1.0 / 4.5e-4**2)
AT_ONCE = 1e9
"""Rate of opening and closing [1/(Pa s)] that moves the leaflets within any step."""

DYNAMICS = {name: kind for name, kind in registered().items() if issubclass(kind, Dynamics)}
valves = pytest.mark.parametrize("kind", DYNAMICS.values(), ids=DYNAMICS.keys())
laws = pytest.mark.parametrize("law", [LINEAR, ORIFICE, NARROWED], ids=["linear", "orifice", "narrowed"])


def advance(
    law: Branch,
    drops: np.ndarray,
    dt: float,
    inertance=0.0,
    opening=AT_ONCE,
    closing=AT_ONCE,
    start=(0.0, 0.0),
):
    """Flows and openings (t,) of BDF2 after a first step of backward Euler, at the pressure drops (t,) [Pa]."""
    states, table, history = np.zeros((STATE_ROWS, 1)), np.array([[law]]), [np.array(start)]
    for n, drop in enumerate(drops):
        memory = 0.5 if n else 0.0
        length = dt / (1.0 + memory)
        before = history[-2] if n else history[-1]
        begin = history[-1] + length * memory / dt * (history[-1] - before)
        states[INERTIA], states[OPENING_RATE], states[CLOSING_RATE] = (
            inertance / length,
            length * opening,
            length * closing,
        )
        states[START_FLOW], states[START_OPENING] = begin[0], np.clip(begin[1], 0.0, 1.0)
        advance_branch(table, 0, 0, drop, states)
        history.append(states[[FLOW, OPENING], 0].copy())
    return np.array(history[1:]).T


def orders(errors: list[float]) -> np.ndarray:
    return np.log2(np.divide(errors[:-1], errors[1:]))


def test_inertial_flow_through_a_resistance_rises_exponentially() -> None:
    r""":math:`q = K \Delta p (1 - e^{-t / (L K)})`, to second order in the step."""
    inertance, drop, end = 1e4, 300.0, 0.05
    exact = 4e-6 * drop * (1.0 - np.exp(-end / (inertance * 4e-6)))
    steps = (50, 100, 200)
    errors = [
        abs(advance(LINEAR, np.full(n, drop), end / n, inertance, start=(0.0, 1.0))[0, -1] - exact)
        for n in steps
    ]
    assert orders(errors) == pytest.approx(2.0, abs=0.15)
    assert errors[-1] < 1e-4 * exact


def test_inertial_flow_through_an_orifice_follows_a_hyperbolic_tangent() -> None:
    r""":math:`q = \sqrt{\Delta p / b} \tanh(t \sqrt{b \Delta p} / L)` of an orifice with :math:`b = \rho / 2 A^2`."""
    area, inertance, drop, end = 4.5e-4, 8.5e4, 600.0, 0.06
    b = 0.5 * BLOOD_DENSITY / area**2
    law = Branch(conductance=1.0).with_narrowing(1.0 / area**2)
    exact = np.sqrt(drop / b) * np.tanh(end * np.sqrt(b * drop) / inertance)
    steps = (50, 100, 200)
    errors = [
        abs(advance(law, np.full(n, drop), end / n, inertance, start=(0.0, 1.0))[0, -1] - exact)
        for n in steps
    ]
    assert orders(errors) == pytest.approx(2.0, abs=0.15)
    assert errors[-1] < 1e-4 * exact


@pytest.mark.parametrize("drop", [200.0, -900.0])
def test_leaflets_open_and_close_exponentially(drop: float) -> None:
    r""":math:`\zeta = 1 - e^{-K_o \Delta p t}` open from 0, :math:`\zeta = e^{K_c \Delta p t}` closing from 1."""
    rates, end = {"opening": 0.3, "closing": 0.05}, 0.02
    rate = abs(drop) * (0.3 if drop > 0.0 else 0.05)
    exact = 1.0 - np.exp(-rate * end) if drop > 0.0 else np.exp(-rate * end)
    start = (0.0, 0.0 if drop > 0.0 else 1.0)
    errors = [
        abs(advance(LINEAR, np.full(n, drop), end / n, start=start, **rates)[1, -1] - exact)
        for n in (20, 40, 80)
    ]
    assert orders(errors) == pytest.approx(2.0, abs=0.2)


@laws
def test_leaflets_without_delay_or_inertance_are_a_diode(law: Branch) -> None:
    """Within the flow that passes in the step in which the leaflets move."""
    drops = np.concatenate([np.full(4, 250.0), np.full(4, -4e3), np.full(4, 80.0)])
    flows, openings = advance(law, drops, 1e-3)
    diode = np.array([branch_flow(np.array([[law]]), 0, 0, drop)[0] for drop in drops])
    assert flows == pytest.approx(diode, rel=1e-4, abs=1e-9)
    assert openings == pytest.approx(np.float64(drops > 0.0), abs=1e-4)


@laws
def test_the_valve_only_dissipates(law: Branch) -> None:
    """The pressure drop less the part that accelerates the blood never drives flow backwards."""
    rng, dt, inertance = np.random.default_rng(4), 2e-3, 8.5e4
    drops = 800.0 * rng.standard_normal(400)
    flows, _ = advance(law, drops, dt, inertance, opening=0.3, closing=0.05)
    before = np.concatenate([[0.0], flows[:-1]])
    older = np.concatenate([[0.0, 0.0], flows[:-2]])
    rates = (1.5 * flows - 2.0 * before + 0.5 * older) / dt
    rates[0] = flows[0] / dt
    power = (drops - inertance * rates) * flows
    assert power.min() > -1e-9 * power.max()
    assert power.max() > 0.0


@laws
@pytest.mark.parametrize("inertance", [0.0, 8.5e4])
def test_the_slope_is_the_derivative(law: Branch, inertance: float) -> None:
    states, table = np.zeros((STATE_ROWS, 1)), np.array([[law]])

    def flow(drop: np.ndarray) -> np.ndarray:
        return np.array([advance_branch(table, 0, 0, drop[0], states)[0]])

    for opening, drop in product((0.03, 0.3, 0.6, 1.0), (-8e3, -300.0, -20.0, 30.0, 500.0)):
        states[:5, 0] = inertance / 4e-3, 4e-3 * 0.3, 4e-3 * 0.05, 1.5e-4, opening
        step = np.array([0.05 * drop])
        slope = advance_branch(table, 0, 0, drop, states)[1] * step
        assert_derivative(flow, slope, np.array([drop]), step)


def test_a_valve_that_closes_late_loses_blood_until_its_leaflets_meet() -> None:
    """The volume that flows back through a resistance is K / K_c in the limit: it does not depend on the pressure."""
    for drop in (-500.0, -2e3):
        flows = advance(LINEAR, np.full(4000, drop), 1e-4, closing=0.05, start=(0.0, 1.0))[0]
        assert 1e-4 * flows.sum() == pytest.approx(-4e-6 / 0.05, rel=0.01)


def valve_of(dynamics: Dynamics) -> Branch:
    """Law of the valve with its dynamics, in the standard heart."""
    network = Network(Heart().circulation, (dynamics,))
    return Branch(*network.laws(0.0)[network.names.index(dynamics.valve)])


def test_all_valves_have_dynamics_of_the_same_form() -> None:
    """The parameters are those of the base class, with own symbols; each valve has its own values."""
    assert {kind.valve for kind in DYNAMICS.values()} == VALVES.keys()
    base = list(parameters_of(ValveDynamics))
    for kind in DYNAMICS.values():
        own = list(parameters_of(kind))
        assert [(p.name, p.unit, p.meaning, p.sd) for p in own] == [
            (p.name, p.unit, p.meaning, p.sd) for p in base
        ]
    symbols = [p.symbol for kind in DYNAMICS.values() for p in parameters_of(kind)]
    assert len({*symbols}) == len(symbols)


@valves
@pytest.mark.parametrize("slowness", [0.5, 1.0])
def test_steady_flow_takes_conductance_and_speed(kind: type[Dynamics], slowness: float) -> None:
    r""":math:`\Delta p = q/K + s \rho q^2 / 2 A^2`, through leaflets that are open in the end."""
    valve = kind(slowness=slowness)
    flows, openings = advance(valve_of(valve), np.full(2000, 300.0), 1e-3, *valve.leaflets())
    conductance = getattr(Heart().circulation, kind.valve).open
    drop = flows[-1] / conductance + slowness * 0.5 * BLOOD_DENSITY * (flows[-1] / valve.area) ** 2
    assert drop == pytest.approx(300.0, rel=1e-6)
    assert openings[-1] == pytest.approx(1.0, abs=1e-6)


@valves
def test_a_pulse_of_pressure_gives_flow_and_opening_to_second_order(kind: type[Dynamics]) -> None:
    def end(n: int) -> np.ndarray:
        drops = 600.0 * np.sin(0.75 * np.pi * np.arange(1, n + 1) / n)
        return advance(valve_of(kind()), drops, 0.06 / n, *kind().leaflets())[:, -1]

    exact = end(12800)
    errors = [abs(end(n) / exact - 1.0) for n in (200, 400, 800)]
    assert orders(np.array(errors)) == pytest.approx(2.0, abs=0.1)


@valves
def test_a_quick_valve_is_the_diode(kind: type[Dynamics]) -> None:
    """The difference is proportional to the slowness, except in the steps in which the leaflets move."""
    drops, steady = np.repeat([250.0, -4e3, 80.0], 40), np.arange(120) % 40 > 5
    law = valve_of(kind().turned_off())
    diode = np.array([branch_flow(np.array([[law]]), 0, 0, drop)[0] for drop in drops])[steady]
    differences = []
    for slowness in (1e-3, 1e-4, 1e-5):
        valve = kind(slowness=slowness)
        flows = advance(valve_of(valve), drops, 1e-3, *valve.leaflets())[0][steady]
        differences.append(abs(flows - diode).max() / diode.max())
    assert np.divide(differences[1:], differences[:-1]) == pytest.approx(0.1, rel=0.1)
    assert differences[-1] < 3e-4


@valves
def test_a_beat_conserves_blood_and_its_valve_opens_and_closes(
    kind: type[Dynamics], spherical_heart: Heart, spheres: SphericalBody
) -> None:
    heart, histories = spherical_heart + kind(), []
    simulate(heart, spheres, Numerics(max_beats=1, tolerances=TIGHT), watch=histories.append)
    (states,) = histories
    assert lost_blood(heart, states) == pytest.approx(np.zeros(4), abs=1e-13)
    opening = np.array([state.branches[1] for state in states[1:]])
    assert (opening >= 0.0).all()
    assert (opening <= 1.0).all()
    own = opening[:, [*VALVES].index(kind.valve)]
    assert own.max() > 0.95
    assert own.min() < 0.01


def test_all_valves_together_only_delay_ejection(spherical_heart: Heart, spheres: SphericalBody) -> None:
    """Ejected volumes and peak flows change by a few per cent; at most some millilitres flow back in each valve."""
    without = simulate(spherical_heart, spheres, Numerics())
    heart = spherical_heart
    for kind in DYNAMICS.values():
        heart += kind()
    beat = simulate(heart, spheres, Numerics())
    dt = beat.time[1] - beat.time[0]
    for valve in VALVES:
        flow, before = beat.flow[valve], without.flow[valve]
        assert flow.max() == pytest.approx(before.max(), rel=0.05)
        assert flow.sum() == pytest.approx(before.sum(), rel=0.06)
        assert 0.3e-6 < -dt * np.minimum(flow, 0.0).sum() < 4e-6

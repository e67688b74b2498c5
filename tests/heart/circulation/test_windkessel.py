"""The four-element Windkessel against its impedance, its limits and its blood balance."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.heart.circulation.elements import EJECTION_TIME, PULMONARY, Windkessel, WindkesselState

TREES = [Windkessel(), PULMONARY]
pytestmark = pytest.mark.parametrize("tree", TREES, ids=["systemic", "pulmonary"])


def arterial(tree: Windkessel, state: WindkesselState, inflow: float) -> float:
    """Pressure at the valve when ``state`` was reached with ``inflow``."""
    return state.P_c + tree.Z_c * (inflow - state.q_L)


def test_steady_flow_meets_the_peripheral_resistance(tree: Windkessel) -> None:
    state = WindkesselState(tree.P_ve)
    for _ in range(2000):
        state = tree.advance(state, 8e-5, 0.1)
    assert arterial(tree, state, 8e-5) == pytest.approx(tree.P_ve + tree.R_p * 8e-5, rel=1e-9)


def test_pressure_runs_off_with_the_characteristic_time(tree: Windkessel) -> None:
    def left_after_one_tau(steps: int) -> float:
        state = WindkesselState(tree.P_ve + 1e4)
        for _ in range(steps):
            state = tree.advance(state, 0.0, tree.tau / steps)
        return (state.P_c - tree.P_ve) / 1e4

    errors = [abs(left_after_one_tau(n) - np.exp(-1.0)) for n in (100, 200, 400)]
    assert (np.log2(np.divide(errors[:-1], errors[1:])) > 0.95).all()


def test_affine_pressure_is_that_of_the_advanced_state(tree: Windkessel) -> None:
    rng = np.random.default_rng(1)
    for _ in range(50):
        state = WindkesselState(rng.uniform(0.0, 2e4), rng.uniform(-1e-4, 5e-4))
        q, dt = rng.uniform(-1e-4, 6e-4), 10 ** rng.uniform(-4, -1)
        a, b = tree.affine_pressure(state, dt)
        assert a + b * q == pytest.approx(arterial(tree, tree.advance(state, q, dt), q), rel=1e-12)


def test_endless_inertance_leaves_three_elements_and_none_leaves_two(tree: Windkessel) -> None:
    state, q = WindkesselState(9e3), 3e-4
    for inertance, resistance in ((1e15, tree.Z_c), (1e-6, 0.0)):
        limit = replace(tree, L=inertance)
        after = limit.advance(state, q, 1e-3)
        assert arterial(limit, after, q) == pytest.approx(after.P_c + resistance * q, rel=1e-6)


def test_oscillating_flow_meets_the_impedance(tree: Windkessel) -> None:
    """The amplitude of the pressure converges to |Z(w)| q with the first order of backward Euler."""
    omega, q = 2.0 * np.pi, 1e-4
    peripheral = tree.R_p / (1.0 + 1j * omega * tree.tau)
    inertial = 1j * omega * tree.L * tree.Z_c / (tree.Z_c + 1j * omega * tree.L)

    def impedance(steps: int) -> complex:
        state, times = WindkesselState(tree.P_ve), np.arange(1, 30 * steps + 1) / steps
        pressures = []
        for time in times:
            flow = q * float(np.cos(omega * time))
            state = tree.advance(state, flow, 1.0 / steps)
            pressures.append(arterial(tree, state, flow))
        carrier = np.exp(-1j * omega * times[-steps:])
        return complex(2.0 * np.mean(np.array(pressures[-steps:]) * carrier) / q)

    errors = [abs(impedance(n) - peripheral - inertial) for n in (50, 100, 200)]
    assert (np.log2(np.divide(errors[:-1], errors[1:])) > 0.9).all()
    assert errors[-1] < 0.03 * abs(peripheral + inertial)


def test_a_pressure_raised_by_its_deficit_returns_to_the_start(tree: Windkessel) -> None:
    inflow = np.clip(3e-4 * np.random.default_rng(2).standard_normal(4000), 0.0, None)

    def after(state: WindkesselState) -> WindkesselState:
        for q in inflow:
            state = tree.advance(state, q, 0.8 / len(inflow))
        return state

    first = WindkesselState(6e3)
    once = after(first)
    periodic = WindkesselState(first.P_c + tree.pressure_deficit(first, once, 0.8), once.q_L)
    assert abs(once.P_c / first.P_c - 1.0) > 0.05
    assert after(periodic).P_c == pytest.approx(periodic.P_c, rel=1e-3)


def test_the_periodic_start_is_kept_by_a_stroke_at_the_middle_of_ejection(tree: Windkessel) -> None:
    steps, stroke = 8000, 9e-5
    start = tree.periodic_start(stroke, 0.8)
    state = start
    for step in range(steps):
        q = stroke * steps / 0.8 if step == round(steps * EJECTION_TIME / 0.8) else 0.0
        state = tree.advance(state, q, 0.8 / steps)
    assert state.P_c == pytest.approx(start.P_c, rel=1e-3)

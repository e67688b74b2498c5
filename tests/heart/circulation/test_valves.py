"""Every valve law: increasing, continuous, with its own slope."""

import numpy as np
import pytest

from heartfit.heart.circulation.elements import LinearValve, OrificeValve, SeriesValve, Valve
from heartfit.roles.laws import BLOOD_DENSITY, Branch
from tests.shrinking import assert_derivative

VALVES = [LinearValve(), OrificeValve(), SeriesValve()]
BOTH_WAYS = Branch(area=1e-4, back_area=1e-4)
valves = pytest.mark.parametrize("valve", VALVES, ids=lambda valve: type(valve).__name__)


@valves
def test_flow_increases_with_the_drop_and_is_continuous(valve: Valve) -> None:
    flows = np.array([valve.law().flow(drop)[0] for drop in np.linspace(-2e4, 2e4, 4001)])
    assert (np.diff(flows) > 0.0).all()
    assert valve.law().flow(0.0)[0] == 0.0
    assert valve.law().flow(1e-9)[0] == pytest.approx(valve.law().flow(-1e-9)[0], abs=1e-13)


@valves
def test_a_closed_valve_leaks_less_than_its_tolerance(valve: Valve) -> None:
    """0.1 mL in a systole of 0.3 s under 15 kPa."""
    assert 0.0 > valve.law().flow(-15e3)[0] * 0.3 > -0.1e-6


@valves
@pytest.mark.parametrize("drop", [-8e3, -30.0, 3.0, 30.0, 400.0, 6e3])
def test_slope_is_the_derivative_of_the_flow(valve: Valve, drop: float) -> None:
    x, direction = np.array([drop]), np.array([0.1 * drop])
    assert_derivative(
        lambda p: np.array([valve.law().flow(p[0])[0]]), valve.law().flow(drop)[1] * direction, x, direction
    )


def test_the_orifice_is_odd_and_follows_bernoulli_beyond_the_smoothing() -> None:
    for drop in (1.0, 40.0, 1e3, 1e4):
        assert BOTH_WAYS.flow(-drop)[0] == -BOTH_WAYS.flow(drop)[0]
        assert BOTH_WAYS.flow(-drop)[1] == BOTH_WAYS.flow(drop)[1]
    assert BOTH_WAYS.flow(1e3)[0] == pytest.approx(1e-4 * np.sqrt(2e3 / BLOOD_DENSITY), rel=1e-3)


@pytest.mark.parametrize("flow", [1e-5, 1e-4, 5e-4])
def test_losses_of_a_series_add(flow: float) -> None:
    valve = SeriesValve(open=3e-6, area=2e-4)
    drop = flow / valve.open + 0.5 * BLOOD_DENSITY * (flow / valve.area) ** 2
    assert valve.law().flow(drop)[0] == pytest.approx(flow, rel=1e-12)


@pytest.mark.parametrize("drop", [-100.0, 50.0, 2e3])
def test_a_series_is_the_valve_whose_other_part_is_wide(drop: float) -> None:
    wide = SeriesValve(open=3e-6, area=10.0).law().flow(drop)
    assert wide == pytest.approx(LinearValve(open=3e-6).law().flow(drop), rel=1e-5)
    if drop > 1e3:  # beyond the smoothing of the orifice
        free = SeriesValve(open=1.0, area=2e-4).law().flow(drop)
        assert free == pytest.approx(OrificeValve(area=2e-4).law().flow(drop), rel=1e-3)

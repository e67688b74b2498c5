"""Branches with inertance and arteries: the closed forms of one step and of a decay."""

import numpy as np
import pytest

from heartfit.roles.laws import NO_LEAFLETS, Branch, branch_flow, inertial_flow
from tests.shrinking import assert_derivative

LINEAR, ORIFICE = Branch(4e-6, 0.0, 1e-11, 0.0), Branch(0.0, 4e-4, 1e-11, 0.0)
laws = pytest.mark.parametrize("law", [LINEAR, ORIFICE], ids=["linear", "orifice"])
DROPS = [-8e3, -50.0, 20.0, 300.0, 5e3]


@laws
@pytest.mark.parametrize("drop", DROPS)
def test_the_drop_drives_flow_and_its_rate(law: Branch, drop: float) -> None:
    """q = f(drop - L (q - q*)), the equation that is solved."""
    table = np.array([[law]])
    for inertance, before in ((1e5, 0.0), (3e6, 2e-4), (1e7, -1e-5)):
        q, _, _ = inertial_flow(table, 0, 0, drop, NO_LEAFLETS, inertance, before)
        assert q == pytest.approx(branch_flow(table, 0, 0, drop - inertance * (q - before))[0], rel=1e-9)


@laws
@pytest.mark.parametrize("drop", DROPS)
def test_the_slope_is_the_derivative_of_the_flow(law: Branch, drop: float) -> None:
    table, x, step = np.array([[law]]), np.array([drop]), np.array([0.1 * drop])
    slope = inertial_flow(table, 0, 0, drop, NO_LEAFLETS, 1e6, 0.0)[1] * step
    assert_derivative(
        lambda p: np.array([inertial_flow(table, 0, 0, p[0], NO_LEAFLETS, 1e6, 0.0)[0]]), slope, x, step
    )


def test_without_inertance_the_flow_is_that_of_the_law() -> None:
    table = np.array([[ORIFICE]])
    flow = inertial_flow(table, 0, 0, 500.0, NO_LEAFLETS, 0.0, 1e-3)
    assert flow == (*branch_flow(table, 0, 0, 500.0), 0.0)


def test_undriven_flow_decays_with_inertance_times_conductance() -> None:
    """Time constant L K = 40 ms: afterwards a fraction 1/e is left, with first order in the step."""
    table, inertance = np.array([[LINEAR]]), 1e4

    def left(dt: float) -> float:
        q = 1.0
        for _ in range(round(0.04 / dt)):
            q, _, _ = inertial_flow(table, 0, 0, 0.0, NO_LEAFLETS, inertance / dt, q)
        return float(q)

    errors = [abs(left(dt) - np.exp(-1.0)) for dt in (4e-4, 2e-4, 1e-4)]
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx([1.0, 1.0], abs=0.05)

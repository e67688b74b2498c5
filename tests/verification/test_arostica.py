"""The benchmark's active stress, by the contractile law and by its own equation."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from verification.arostica import END, LAW, MAXIMUM, TIME, SmoothControl, active_stress
from verification.block_checks import order


@pytest.fixture(scope="module")
def exact():
    """The stress as a function of time, from the benchmark's own equation."""
    a = SmoothControl().rate

    def slope(t, tau):
        return -abs(a(t)) * tau + 150e3 * np.maximum(a(t), 0.0)

    options = {"rtol": 1e-10, "atol": 1e-3, "max_step": 2e-3, "dense_output": True}
    return solve_ivp(slope, (0.0, END), [0.0], **options).sol


def test_the_number_is_that_of_the_equation(exact):
    times = np.linspace(0.47, 0.49, 4001)
    stress = exact(times)[0]
    assert 1e-3 * stress.max() == pytest.approx(MAXIMUM, abs=1e-3)
    assert 1e3 * times[np.argmax(stress)] == pytest.approx(TIME, abs=0.05)


@pytest.mark.parametrize("time", [0.2, 0.4, 0.56])
def test_the_law_converges_to_it_with_the_step(exact, time):
    long, short = (abs(active_stress(dt)[1][round(time / dt)] / exact(time)[0] - 1.0) for dt in (8e-3, 2e-3))
    assert order(long, short, 4.0) > 1.9


def test_an_isometric_fibre_does_not_depend_on_stiffness_or_destruction_of_its_bridges():
    usual, other = (active_stress(2e-3, law)[1] for law in (LAW, replace(LAW, k_0=2.0 * LAW.k_0, alpha=0.0)))
    assert other == pytest.approx(usual, rel=1e-3, abs=1.0)


def test_the_means_are_those_of_the_control():
    control, fine = SmoothControl(), np.linspace(0.155, 0.165, 100001)
    rate, attach = control.mean(0.155, 0.01)
    assert rate[0] == pytest.approx(abs(control.rate(fine)).mean(), rel=0.02)
    assert attach[0] == pytest.approx(np.maximum(control.rate(fine), 0.0).mean(), abs=0.01)

"""Catheter sensors against closed forms and the equation of the oscillator."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from heartfit.mechanisms.catheter_damping import CatheterDamping
from heartfit.mechanisms.catheter_delay import CatheterDelay
from heartfit.mechanisms.catheter_offset import CatheterOffset

PERIOD, COUNT = 0.8, 400
TIMES = np.arange(COUNT) * PERIOD / COUNT - 0.17


def pressure(times: np.ndarray) -> np.ndarray:
    """Up and down within 0.4 s, Pa; smooth enough to interpolate between its samples."""
    wave = 2.0 * np.pi * times / PERIOD
    return 8e3 * np.exp(3.0 * (np.cos(wave) - 1.0)) + 600.0 * np.sin(4.0 * wave)


@pytest.mark.parametrize("offset", [300.0, -250.0])
def test_an_offset_is_added_to_every_sample(offset: float) -> None:
    shown = CatheterOffset(offset).distort(TIMES, pressure(TIMES), PERIOD)
    assert shown == pytest.approx(pressure(TIMES) + offset, rel=1e-15)


@pytest.mark.parametrize("lag", [0.0137, -0.008])
def test_a_delayed_pressure_is_that_of_earlier_times(lag: float) -> None:
    shown = CatheterDelay(lag).distort(TIMES, pressure(TIMES), PERIOD)
    assert shown == pytest.approx(pressure(TIMES - lag), abs=1e-9)


@pytest.mark.parametrize("damping", [0.15, 0.7, 2.0])
def test_the_damped_pressure_is_the_steady_solution_of_the_oscillator(damping: float) -> None:
    """Solution by a Runge-Kutta method of order 8 over enough periods to forget the start."""
    r = 1.0 / (2.0 * np.pi * 12.0)

    def oscillator(time: float, state: np.ndarray) -> list[float]:
        return [state[1], (pressure(np.array(time)) - state[0]) / r**2 - 2.0 * damping / r * state[1]]

    late = TIMES + 3.0 * PERIOD
    solved = solve_ivp(oscillator, (0.0, late[-1]), [0.0, 0.0], "DOP853", late, rtol=1e-9, atol=1e-6)
    shown = CatheterDamping(r, damping).distort(TIMES, pressure(TIMES), PERIOD)
    assert shown == pytest.approx(solved.y[0], abs=0.01)


@pytest.mark.parametrize("k", [1, 5, 12])
def test_each_harmonic_has_the_gain_and_the_lag_of_the_oscillator(k: int) -> None:
    """With x the frequency over the natural one: gain 1 / sqrt((1 - x^2)^2 + (2 zeta x)^2), lag by arctan."""
    natural, damping = 15.0, 0.2
    x, wave = k / PERIOD / natural, 2.0 * np.pi * k * TIMES / PERIOD
    gain = 1.0 / np.hypot(1.0 - x**2, 2.0 * damping * x)
    lag = np.arctan2(2.0 * damping * x, 1.0 - x**2)
    shown = CatheterDamping(1.0 / (2.0 * np.pi * natural), damping).distort(TIMES, np.cos(wave), PERIOD)
    assert shown == pytest.approx(gain * np.cos(wave - lag), abs=1e-12)


def test_a_stiff_line_is_a_short_delay() -> None:
    """To first order in r the oscillator delays by 2 zeta r: half of r leaves a quarter of the difference."""
    errors = []
    for r in (2e-3, 1e-3):
        shown = CatheterDamping(r, 0.5).distort(TIMES, pressure(TIMES), PERIOD)
        errors.append(abs(shown - pressure(TIMES - 2.0 * 0.5 * r)).max())
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)


def test_the_mean_pressure_stays() -> None:
    for sensor in (CatheterDamping(), CatheterDelay()):
        shown = sensor.distort(TIMES, pressure(TIMES), PERIOD)
        assert shown.mean() == pytest.approx(pressure(TIMES).mean(), rel=1e-12)

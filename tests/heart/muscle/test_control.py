"""The control's mean over a step: exact, periodic and independent of how activation falls between steps."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.heart.muscle.control import Control
from heartfit.mechanisms.slow_relaxation import SlowRelaxation

CONTROL, PERIOD = Control(), 0.829
ACTIVATION = np.linspace(0.0, 0.09, 37)


@pytest.mark.parametrize("steps", [7, 83, 166])
def test_every_point_is_depolarised_for_its_action_potential_in_each_period(steps: int) -> None:
    dt = PERIOD / steps
    means = [CONTROL.mean(n * dt, dt, ACTIVATION, PERIOD) for n in range(steps)]
    attached = dt * sum(attach for _, attach in means)
    detached = dt * sum(rate - attach for rate, attach in means)
    assert attached == pytest.approx(CONTROL.k_ATP * CONTROL.duration)
    assert detached == pytest.approx(CONTROL.k_RS * (PERIOD - CONTROL.duration))


def test_depolarisation_begins_and_ends_where_the_step_is_cut() -> None:
    """A step of 10 ms of which the point spends 4 ms depolarised."""
    begin, end = CONTROL.onset + 0.05, CONTROL.onset + 0.05 + CONTROL.duration
    for start in (begin - 0.006, end - 0.004):
        rate, attach = CONTROL.mean(start, 0.01, np.array([0.05]), PERIOD)
        assert attach == pytest.approx(0.4 * CONTROL.k_ATP)
        assert rate == pytest.approx(0.4 * CONTROL.k_ATP + 0.6 * CONTROL.k_RS)


def test_the_control_is_periodic() -> None:
    times = np.linspace(0.0, PERIOD, 50)
    for beats in (1, 5):
        for time in times:
            now, later = (CONTROL.mean(t, 5e-3, ACTIVATION, PERIOD)[1] for t in (time, time + beats * PERIOD))
            assert later == pytest.approx(now, abs=1e-9)


def test_an_action_potential_longer_than_the_period_is_refused() -> None:
    with pytest.raises(ValueError, match=r"0\.34 s.*0\.3 s"):
        CONTROL.mean(0.0, 5e-3, ACTIVATION, 0.3)


def test_a_tail_reduces_the_rate_of_every_step_by_its_share() -> None:
    """Compared with the rate at 4000 times of each step, including the short one after the longest pause."""
    tail = SlowRelaxation(slowing=0.7, transition=0.05)
    slowed, dt = replace(CONTROL, tails=(tail,)), PERIOD / 23
    places = (np.arange(4000) + 0.5) * dt / 4000
    for n in range(23):
        since = np.mod(n * dt + places[:, None] - CONTROL.onset - ACTIVATION, PERIOD) - CONTROL.duration
        share = 1.0 - 0.7 / 1.7 * -np.expm1(-np.maximum(since, 0.0) / 0.05)
        expected = np.where(since < 0.0, CONTROL.k_ATP, CONTROL.k_RS * share).mean(axis=0)
        rate, attach = slowed.mean(n * dt, dt, ACTIVATION, PERIOD)
        assert rate == pytest.approx(expected, rel=1e-3)
        assert (attach == CONTROL.mean(n * dt, dt, ACTIVATION, PERIOD)[1]).all()

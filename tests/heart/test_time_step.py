"""One time step: exactness of its order, damping of stiff modes, steps of unequal length."""

import numpy as np
import pytest

from heartfit.heart.time_step import STATIC_STEP, TimeStep

STEPS = pytest.mark.parametrize("lengths", [(2e-3, 2e-3), (1e-3, 3e-3), (4e-3, 1e-3)])


def rate_at_end(y: np.ndarray, lengths: tuple[float, float], second_order: bool = True) -> float:
    """Rate that the scheme assigns to the last of the values ``y`` at three times."""
    step = TimeStep(0.0, lengths[1], 1.0, second_order, lengths[0])
    return float((y[2] - step.starting_value(y[1], y[0])) / step.effective)


@STEPS
def test_second_order_differentiates_parabolas_exactly(lengths: tuple[float, float]) -> None:
    t = np.cumsum([0.1, *lengths])
    assert rate_at_end(3.0 * t**2 - t, lengths) == pytest.approx(6.0 * t[-1] - 1.0)


@STEPS
def test_starting_value_and_extrapolation_agree(lengths: tuple[float, float]) -> None:
    y = np.array([0.3, -0.2, 1.1])
    step = TimeStep(0.0, lengths[1], 1.0, last=lengths[0])
    mean, before = np.diff(y)[::-1] / lengths[::-1]
    assert step.end_value(mean, before) == pytest.approx(rate_at_end(y, lengths))


@pytest.mark.parametrize("step", [TimeStep(0.2, 5e-3, 1.0, False, 5e-3), TimeStep(0.2, 5e-3, 1.0)])
def test_without_memory_the_scheme_is_backward_euler(step: TimeStep) -> None:
    assert (step.memory, step.effective, step.starting_value(1.0, 7.0), step.end_value(2.0, 9.0)) == (
        0.0,
        5e-3,
        1.0,
        2.0,
    )


def test_stiff_modes_are_damped() -> None:
    """y' = -1e5 y: the memory of y decays to nothing in a few steps."""
    y = [1.0, 1.0]
    for _ in range(20):
        step = TimeStep(0.0, 5e-3, 1.0, last=5e-3)
        y.append(step.starting_value(y[-1], y[-2]) / (1.0 + 1e5 * step.effective))
    assert abs(y[-1]) < 1e-12


def test_the_halves_of_a_step_add_up_to_the_step() -> None:
    whole = TimeStep(0.3, 4e-3, 0.8, last=4e-3)
    first, second = whole.half(second=False), whole.half(second=True)
    assert (first.start, second.end) == (whole.start, pytest.approx(whole.end))
    assert first.end == pytest.approx(second.start)
    assert (first.last, second.last) == (4e-3, 2e-3)


def test_a_static_step_has_no_rates() -> None:
    assert STATIC_STEP.memory == 0.0
    assert 1.0 / STATIC_STEP.effective == 0.0

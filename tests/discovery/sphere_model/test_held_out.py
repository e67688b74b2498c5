"""Likelihood of held-out data with and without a cause."""

import numpy as np
import pytest

from heartfit.discovery.inference.data import Block, Data, Noise
from heartfit.discovery.sphere_model.held_out import HeldOutPrediction

SD, PERIOD = 2e-6, 0.8
TIMES = np.arange(20) * PERIOD / 20
BLOCK = Block("lv_volume", "m^3", TIMES, PERIOD, Noise((SD,), 0.0, 0.0, 0.0))
TRUE = 100e-6 + 40e-6 * np.cos(2.0 * np.pi * TIMES / PERIOD)


def predicted(baseline, extended):
    """White noise of one level, and predictions that err by these numbers of its standard deviations."""
    errors = (TRUE + SD * error * np.ones(20) for error in (baseline, extended))
    return HeldOutPrediction("held out", Data(TRUE, (BLOCK,)), *errors)


def test_the_gain_in_likelihood_is_half_the_difference_of_the_squares_in_units_of_noise():
    assert predicted(3.0, 1.0).log_likelihood_gain() == pytest.approx(0.5 * 20 * (3.0**2 - 1.0**2))


@pytest.mark.parametrize(
    ("baseline", "extended", "helps"),
    [(1.0, 0.9, True), (1.0, -1.1, False), (0.0, 3.0, False), (1.0, 1.0, False)],
)
def test_a_cause_helps_only_if_it_makes_held_out_data_more_likely(baseline, extended, helps):
    assert predicted(baseline, extended).helps() is helps

"""Slopes of one heart become the covariance of another's observations."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.calibration.sensitivity import Slopes
from heartfit.core.errors import InputError

SLOPES = Slopes(
    ("a", "b", "c"), ("V_min", "q_max", "q_min"), np.array([[1.0, 2.0, 0.5], [0.3, -0.4, 0.2], [0, 1, 0]])
)


def test_slopes_are_scaled_by_what_was_observed_and_leave_out_what_is_estimated():
    covariance = SLOPES.covariance({"a", "c"}, {"q_min": -5.0, "V_min": 2.0}, 0.1)
    vector = 0.1 * np.array([-5.0 * 0.2, 2.0 * 0.3])
    assert covariance == pytest.approx(np.outer(vector, vector))
    assert SLOPES.covariance({"a", "b", "c"}, {"V_min": 2.0}, 0.1) == pytest.approx(np.zeros((1, 1)))


def test_parameters_unknown_to_the_slopes_are_named():
    with pytest.raises(InputError, match="P_max"):
        SLOPES.covariance({"a"}, {"P_max": 1.0}, 0.1)
    lost = replace(SLOPES, relative=np.where(np.eye(3) > 0, np.nan, 1.0))
    with pytest.raises(InputError, match=r"slopes.*\bb\b"):
        lost.covariance({"a", "c"}, {"V_min": 1.0, "q_max": 1.0}, 0.1)

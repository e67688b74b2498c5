"""Errors on held-out data and their ratio."""

import numpy as np
import pytest

from heartfit.discovery.sphere_model.held_out import error_ratio


def test_the_ratio_is_that_of_the_errors_and_its_interval_holds_it():
    rng = np.random.default_rng(0)
    phase, none = np.linspace(0.0, 0.999, 400), rng.standard_normal(400)
    extended = 0.5 * rng.standard_normal(400)
    ratio, (low, high) = error_ratio(phase, none, extended)
    assert ratio == pytest.approx(np.sqrt(np.mean(extended**2) / np.mean(none**2)))
    assert low < ratio < high < 1.0


def test_errors_that_are_the_same_have_the_ratio_one():
    error = np.sin(np.arange(40.0))
    ratio, interval = error_ratio(np.arange(40) / 40, error, error)
    assert (ratio, *interval) == pytest.approx((1.0, 1.0, 1.0))


def test_one_outlying_phase_widens_the_interval():
    phase = np.arange(80) / 80
    none, extended = np.ones(80), np.full(80, 0.5)
    extended[:10] = 3.0
    _, (low, high) = error_ratio(phase, none, extended)
    assert low < 0.6
    assert high > 1.2

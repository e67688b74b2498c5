"""Race of methods: marks count simulations; on a linear map the noise-aware methods end at the posterior."""

import numpy as np
import pytest

from heartfit.calibration.alternatives import has_cma
from heartfit.calibration.unscented import sigma_points
from heartfit.calibration.update import calibrate
from heartfit.synthetic.race import (
    CalibrationProblem,
    compare_methods,
    compare_on_spheres,
    estimate_errors,
    methods,
)
from tests.synthetic.linear import linear_hearts

HEARTS = linear_hearts()
HEART = HEARTS.draw(0, "nothing")
PROBLEM = CalibrationProblem(HEARTS.model.observe_all, HEARTS.prior, HEART.observed, HEART.noise, HEART.truth)


def test_simulations_are_those_of_the_points_and_stay_within_the_most() -> None:
    marks = compare_methods(PROBLEM, methods(30, 2), 30, heart=7)
    counts = {name: [mark.simulations for mark in marks if mark.method == name] for name in marks_of(marks)}
    assert counts.pop("CMA-ES", [8, 16, 24]) == [8, 16, 24]
    assert counts == {
        "prior": [0],
        "unscented, R = 0": [9, 18],
        "unscented, R > 0": [9, 18],
        "simplex, R > 0": [6, 12],
        "ensemble smoother": [28],
    }
    assert {mark.heart for mark in marks} == {7}


def marks_of(marks) -> list[str]:
    return list(dict.fromkeys(mark.method for mark in marks))


def test_a_method_that_loses_its_points_is_stopped_and_the_others_go_on() -> None:
    def forward(parameters):
        return ["no beat"] * len(parameters)

    marks = compare_methods(
        CalibrationProblem(forward, HEARTS.prior, HEART.observed, HEART.noise, HEART.truth),
        methods(30, 2),
        30,
    )
    assert marks_of(marks) == ["prior", "CMA-ES"][: 1 + has_cma()]
    assert np.isnan(marks[0].observations)


def test_errors_are_zero_at_the_truth_of_an_exact_measurement_and_one_a_deviation_away() -> None:
    (exact,) = HEARTS.model.observe_all([HEARTS.prior.physical(HEART.truth)])
    problem = CalibrationProblem(HEARTS.model.observe_all, HEARTS.prior, exact, HEART.noise, HEART.truth)
    assert estimate_errors(problem, HEART.truth) == pytest.approx((0.0, 0.0), abs=1e-9)
    assert estimate_errors(problem, HEART.truth + HEARTS.prior.sd)[1] == pytest.approx(1.0)


def test_on_a_linear_map_every_unscented_step_is_the_posterior() -> None:
    outcomes = HEARTS.model.observe_all([point.parameters for point in sigma_points(HEARTS.prior)])
    posterior = calibrate(HEARTS.prior, outcomes, HEART.observed, HEART.noise).estimate
    expected = estimate_errors(PROBLEM, posterior.mean)
    for mark in compare_methods(PROBLEM, methods(30, 2), 30):
        if mark.method in ("unscented, R > 0", "simplex, R > 0"):
            assert (mark.observations, mark.parameters) == pytest.approx(expected, rel=1e-6)


def test_hearts_are_numbered() -> None:
    marks = compare_on_spheres(linear_hearts(), 2, 30, 1)
    assert {mark.heart for mark in marks} == {0, 1}

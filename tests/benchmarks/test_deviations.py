"""Steps on both scales: equal for a map that is nearly linear, and impossible points are named and survive."""

import numpy as np
import pytest

from benchmarks.deviations_step import ADDITIVE, LOGARITHMIC, take_step, widened
from heartfit.calibration.gaussian import Gaussian

PRIOR = Gaussian.from_relative({"a": 2.0, "b": 5.0}, {"a": 0.2, "b": 0.3})


def power(parameters: list[dict[str, float]]) -> list[dict[str, float]]:
    """A map that is linear in the logarithms of both parameters."""
    return [
        {"x": np.log(entry["a"]) + np.log(entry["b"]), "y": np.log(entry["a"]) - np.log(entry["b"])}
        for entry in parameters
    ]


def line(parameters: list[dict[str, float]]) -> list[dict[str, float]]:
    """A map that is linear in the parameters."""
    return [{"x": entry["a"] + entry["b"], "y": entry["a"] - entry["b"]} for entry in parameters]


@pytest.mark.parametrize(("forward", "scale"), [(power, LOGARITHMIC), (line, ADDITIVE)])
def test_a_step_on_the_scale_of_the_map_is_exact(forward, scale: str) -> None:
    (observed,) = forward([{"a": 2.6, "b": 4.0}])
    step = take_step(PRIOR, forward, observed, scale)
    assert step.estimate == pytest.approx({"a": 2.6, "b": 4.0})
    assert step.impossible == 0


def test_a_step_on_the_other_scale_is_not() -> None:
    (observed,) = line([{"a": 2.6, "b": 2.0}])
    step = take_step(PRIOR, line, observed, LOGARITHMIC)
    assert step.estimate["b"] != pytest.approx(2.0, rel=1e-2)


def test_the_longest_move_is_in_prior_deviations() -> None:
    (observed,) = line([{"a": 2.0, "b": 5.0 * 1.6}])
    assert take_step(PRIOR, line, observed, ADDITIVE).longest == pytest.approx(2.0)


def test_a_point_below_zero_is_not_simulated_and_does_not_spoil_a_linear_map() -> None:
    wide, simulated = widened(PRIOR, 3.0), []

    def forward(parameters):
        simulated.extend(parameters)
        return line(parameters)

    (observed,) = line([{"a": 2.6, "b": 4.0}])
    step = take_step(wide, forward, observed, ADDITIVE)
    assert step.impossible == 1
    assert len(simulated) == 4
    assert min(value for entry in simulated for value in entry.values()) > 0.0
    assert step.estimate == pytest.approx({"a": 2.6, "b": 4.0})


def test_a_step_that_ends_below_zero_has_no_estimate() -> None:
    assert take_step(PRIOR, line, {"x": 1.0, "y": 5.0}, ADDITIVE).estimate == {}


def test_a_wider_prior_keeps_its_medians() -> None:
    wide = widened(PRIOR, 2.0)
    assert wide.physical() == pytest.approx({"a": 2.0, "b": 5.0})
    assert wide.sd == pytest.approx([0.4, 0.6])

"""A setting of two iterations: where its second one starts, and its fields taken from another setting."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import sigma_points
from heartfit.calibration.update import calibrate, narrowed
from heartfit.io.configuration import read_yaml
from heartfit.study.study import Study

CONFIG = Path(__file__).parents[2] / "config" / "config.yaml"
TWICE = {"like": "locking", "iterations": 2}


def changed(settings: dict[str, Any]) -> Study:
    """Return the study with these settings changed or removed."""
    content = read_yaml(CONFIG)
    return Study.model_validate(content | {"settings": content["settings"] | settings})


def test_a_second_iteration_starts_at_the_estimate_of_the_same_setting_with_one() -> None:
    study = changed(settings={"again": TWICE})
    assert study.first_step("again") == "locking"
    assert study.first_step("locking") == "locking"
    assert study.settings["again"].estimate == study.settings["locking"].estimate
    assert study.perturbed_as("again") == "locking", "both use the same perturbed beats"


def test_a_second_iteration_needs_a_first_one_for_all_its_cases() -> None:
    with pytest.raises(ValidationError, match=r"settings\.again: a second iteration starts at the estimate"):
        changed(settings={"again": {**TWICE, "estimate": ["mu"]}})
    with pytest.raises(ValidationError, match=r"settings\.again"):
        changed(
            settings={
                "one": {"like": "locking", "cases": ["v2"]},
                "again": {**TWICE, "like": "one"},
                "locking": None,
            }
        )


@pytest.mark.parametrize("like", ["nothing", "again", 3])
def test_a_setting_is_like_a_known_one(like: object) -> None:
    with pytest.raises(ValidationError, match=r"settings\.again\.like.*expected a setting"):
        changed(settings={"again": {**TWICE, "like": like}})


def test_a_removed_setting_takes_those_like_it_along() -> None:
    study = changed(settings={"again": TWICE, "locking": None})
    assert "again" not in study.settings


def test_two_steps_on_a_bent_map_come_nearer_than_one() -> None:
    """The map exp(2 x) is bent; a straight step from far away misses, and the second starts near its target."""
    prior = Gaussian(("x",), np.zeros(1), np.eye(1))
    observed = {"z": float(np.exp(2.0 * 1.5))}

    def outcomes(around: Gaussian) -> list[dict[str, float]]:
        return [{"z": float(np.exp(2.0 * point.z[0]))} for point in sigma_points(around)]

    first = calibrate(prior, outcomes(prior), observed)
    around = narrowed(prior, first.estimate.mean)
    second = calibrate(prior, outcomes(around), observed, around=around)
    errors = [abs(posterior.estimate.mean[0] - 1.5) for posterior in (first, second)]
    assert errors[1] < 0.5 * errors[0]
    assert second.prior is prior, "the data are used once, with the prior of the first"


def test_on_a_linear_map_the_second_step_stays_where_the_first_arrived() -> None:
    prior = Gaussian(("x", "y"), np.array([0.3, -0.2]), np.diag([0.04, 0.09]))
    slope = np.array([[1.0, 0.5], [-0.3, 2.0]])

    def outcomes(around: Gaussian) -> list[dict[str, float]]:
        return [dict(zip("ab", 3.0 + slope @ point.z, strict=True)) for point in sigma_points(around)]

    observed, noise = {"a": 3.4, "b": 2.5}, np.diag([0.01, 0.02])
    first = calibrate(prior, outcomes(prior), observed, noise)
    around = narrowed(prior, first.estimate.mean)
    second = calibrate(prior, outcomes(around), observed, noise, around=around)
    assert second.estimate.mean == pytest.approx(first.estimate.mean, rel=1e-9)
    assert second.estimate.covariance == pytest.approx(first.estimate.covariance, rel=1e-7)

"""Limits are read in SI, ranges and indices survive a file."""

from math import inf
from pathlib import Path

import numpy as np
import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.plausible import End, Plausible, PlausibleRange
from heartfit.calibration.sensitivity import Sensitivity
from heartfit.calibration.sobol import SobolIndices
from heartfit.io.noise_models import read_limits, read_ranges, read_sobol, write_ranges, write_sobol
from heartfit.io.results import read_sensitivity, write_sensitivity

RESOURCES = Path(__file__).parents[2] / "resources"


def test_the_published_limits_are_in_si() -> None:
    limits = {limit.quantity: limit for limit in read_limits(RESOURCES / "plausible_beat.csv")}
    assert (limits["EF"].low, limits["EF"].high) == pytest.approx((0.48, 0.71))
    assert limits["P_max"].high == pytest.approx(140 * 133.322)
    assert limits["dPdt_max"].high == inf
    assert limits["dPdt_min"].holds(-200e3)


def test_ranges_round_trip(tmp_path: Path) -> None:
    original = Plausible((PlausibleRange("K", 1e6, End(0.5, "cap"), End(1.5, "EF")),), ("dPdt_min",))
    write_ranges(tmp_path / "ranges.json", original, "abc")
    assert read_ranges(tmp_path / "ranges.json") == original


def test_sensitivities_round_trip(tmp_path: Path) -> None:
    prior = Gaussian.from_relative({"sigma_0": 3e5, "mu": 9e3}, {"sigma_0": 0.2, "mu": 0.2})
    original = Sensitivity(prior, ("V_min",), np.ones(1), np.eye(2)[:, :1], np.ones((2, 1)), ("mu+ (cold)",))
    write_sensitivity(tmp_path / "found.json", original, "abc")
    again = read_sensitivity(tmp_path / "found.json")
    assert (again.parameters, again.observations, again.failed) == (prior.names, ("V_min",), original.failed)
    assert again.slopes == pytest.approx(original.slopes)
    assert again.covariance == pytest.approx(original.covariance)
    assert again.prior.sd == pytest.approx(prior.sd)


def test_indices_round_trip(tmp_path: Path) -> None:
    values = np.arange(2.0)[:, None]
    original = SobolIndices(("a", "b"), ("Z",), values, values, values, values, 8, ("cold",))
    write_sobol(tmp_path / "sobol.json", original, "abc")
    again = read_sobol(tmp_path / "sobol.json")
    assert (again.parameters, again.samples, again.lost) == (("a", "b"), 8, ("cold",))
    assert again.total == pytest.approx(values)

"""A case of a linear heart, whose posterior is the closed form."""

import numpy as np
import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import sigma_points
from heartfit.calibration.update import calibrate
from heartfit.observation.curve import Curve
from heartfit.observation.measurement import Measurement, Observation
from heartfit.results.case import summarise
from heartfit.results.exchange import Calibrated

PRIOR = Gaussian.from_relative({"sigma_0": 300e3, "mu": 9e3}, {"sigma_0": 0.2, "mu": 0.3})
SLOPES = np.array([[-10e-6, 40e-6], [2e-6, -30e-6]])
"""Slopes of the observations [m^3, m^3/s] by the logarithms of the parameters."""
AT_PRIOR = np.array([60e-6, 400e-6])
NOISE = np.array([[4e-12, 3e-12], [3e-12, 36e-12]])


def observed_at(z: np.ndarray) -> dict[str, float]:
    return dict(zip(("V_min", "q_max"), AT_PRIOR + (z - PRIOR.mean) @ SLOPES, strict=True))


@pytest.fixture(scope="session")
def calibrated() -> Calibrated:
    """Observed without bias at 1.2 and 0.8 of the prior's parameters."""
    true = observed_at(PRIOR.mean + np.log([1.2, 0.8]))
    outcomes = [observed_at(point.z) for point in sigma_points(PRIOR)]
    noise_free, noise_aware = (calibrate(PRIOR, outcomes, true, noise) for noise in (None, NOISE))
    units = {"V_min": "m^3", "q_max": "m^3/s"}
    deviations = dict(zip(units, np.sqrt(np.diag(NOISE)).tolist(), strict=True))
    observations = [Observation(name, true[name], units[name], deviations[name], 0.0) for name in units]
    measurement = Measurement(observations, NOISE)
    times = np.arange(20) * 0.04
    curve = Curve.of_volume(times, 1e-4 + 4e-5 * np.cos(2.0 * np.pi * times / 0.8), 0.8)
    curves = {"measured": {"lv_volume": curve}, "reference": {}, "calibrated": {"lv_volume": curve}}
    identity = {"case": "heart1", "setting": "physical", "fingerprint": "0123"}
    case = summarise(identity, noise_free, measurement, curves, {}, {"sigma_0": "Pa", "mu": "Pa.s"})
    return Calibrated(case, noise_free, noise_aware, measurement, curves["measured"], curves["calibrated"])

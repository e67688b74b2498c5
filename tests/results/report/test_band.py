"""The band of a curve that is linear in the parameters is that of the linear map."""

import numpy as np
import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import sigma_points
from heartfit.observation.curve import Curve
from heartfit.results.report.record import curve_deviation
from tests.results.report.small_report import PERIOD, PRIOR, TIMES, WAVE

SLOPES = np.array([2e-5, -1e-5])
POSTERIOR = Gaussian(PRIOR.names, PRIOR.mean, np.array([[0.01, 0.004], [0.004, 0.02]]))


def beats() -> list[dict[str, Curve]]:
    return [
        {"lv_volume": Curve(TIMES, 1e-4 + WAVE * ((point.z - PRIOR.mean) @ SLOPES), PERIOD)}
        for point in sigma_points(PRIOR)
    ]


def test_a_linear_map_gives_its_own_band() -> None:
    deviation = curve_deviation(PRIOR, sigma_points(PRIOR), beats(), POSTERIOR, beats()[0])["lv_volume"]
    assert deviation.values == pytest.approx(
        WAVE * np.sqrt(SLOPES @ POSTERIOR.covariance @ SLOPES), abs=1e-12
    )


def test_one_lost_point_keeps_the_band_and_too_many_remove_it() -> None:
    points, whole = sigma_points(PRIOR), beats()
    one, none = [*whole[:4], {}], [whole[0], {}, {}, {}, {}]
    assert curve_deviation(PRIOR, points, one, POSTERIOR, whole[0])["lv_volume"].values == pytest.approx(
        WAVE * np.sqrt(SLOPES @ POSTERIOR.covariance @ SLOPES), abs=1e-12
    )
    assert curve_deviation(PRIOR, points, none, POSTERIOR, whole[0]) == {}

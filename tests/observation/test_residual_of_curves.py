"""Residuals of curves in closed form: sign, noise, bias, and beats that failed."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.observation.curve import Curve
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.residual import residuals, unbiased_with_noise
from heartfit.observation.scatter import Scatter

PERIOD = 0.8
TIMES = np.arange(25) * PERIOD / 25
WAVE = np.cos(2.0 * np.pi * TIMES / PERIOD)
VOLUME = Curve(TIMES, 100e-6 + 40e-6 * WAVE, PERIOD)
PRESSURE = Curve(TIMES, 8e3 - 7e3 * WAVE, PERIOD)


def test_a_residual_is_positive_where_the_simulation_is_too_large() -> None:
    larger = replace(VOLUME, values=VOLUME.values + 3e-6)
    (left,) = residuals({"lv_volume": VOLUME}, {"beat": {"lv_volume": larger}, "failed": {}}, [])
    assert set(left.simulated) == {"beat"}
    assert left.difference("beat") == pytest.approx(3e-6)
    assert left.score("beat") == pytest.approx(3e-6 / 0.6e-6), "a curve of one harmonic has no other noise"


@pytest.mark.parametrize(
    ("name", "curve", "roughness"), [("rv_volume", VOLUME, 0.6e-6), ("lv_pressure", PRESSURE, 150.0)]
)
def test_noise_of_the_curve_and_roughness_of_the_simulation_add_up(
    name: str, curve: Curve, roughness: float
) -> None:
    """A harmonic of the upper half of the spectrum counts as noise: of 25 samples, those beyond the sixth."""
    ripple = 2.0 * roughness * np.cos(9 * 2.0 * np.pi * TIMES / PERIOD)
    (left,) = residuals({name: replace(curve, values=curve.values + ripple)}, {}, [])
    estimated = np.sqrt(np.sum(ripple**2) / 12)
    assert left.noise == pytest.approx(np.full(25, np.hypot(estimated, roughness)))


def test_a_noise_model_corrects_each_volume_by_its_own_error_and_leaves_pressures() -> None:
    bias, sd = np.linspace(0.0, 0.1, 25), np.linspace(0.0, 0.04, 25)
    scatter = Scatter(tuple(map(str, range(25))), 24, bias, np.diag(sd**2))
    less = replace(scatter, mean=0.5 * bias, covariance=0.25 * scatter.covariance)
    model = NoiseModel({}, scatter, {"lv_volume": less, "rv_volume": scatter})
    curve, noise = unbiased_with_noise("rv_volume", VOLUME, [model])
    stroke = np.ptp(VOLUME.values)
    assert curve.values == pytest.approx(VOLUME.values - stroke * bias)
    assert noise == pytest.approx(np.sqrt(25 / 24 * (stroke * sd) ** 2 + 0.6e-6**2))
    assert unbiased_with_noise("lv_pressure", PRESSURE, [model])[0] is PRESSURE

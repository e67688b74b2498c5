"""On the measured heart the default operator gives the raw central differences, with noise of known size."""

from pathlib import Path

import pandas as pd
import pytest

from heartfit.observation.curve import Curve
from heartfit.observation.measurement import frame_noise, observe_measured
from heartfit.observation.operator import VolumeFeatures, operators


@pytest.fixture
def left_volume(measured_heart_folder: Path) -> dict[str, Curve]:
    table = pd.read_csv(measured_heart_folder / "volumes.csv")
    return {"lv_volume": Curve.of_volume(table["time_s"], 1e-6 * table["lv_volume_ml"], 0.829)}


def test_the_default_operator_is_the_raw_one(left_volume: dict[str, Curve]) -> None:
    observations = observe_measured(left_volume, operators(left_volume)).observations
    values = [1e6 * observation.value for observation in observations]
    assert values == pytest.approx([72.0, 473.6, -520.2], abs=0.5)
    noise = [observation.noise / abs(observation.value) for observation in observations]
    assert noise == pytest.approx([0.027, 0.085, 0.08], abs=0.01)


def test_frames_are_scattered_by_about_two_millilitres(left_volume: dict[str, Curve]) -> None:
    assert frame_noise(left_volume["lv_volume"]) == pytest.approx(1.9e-6, abs=0.1e-6)


def test_a_wide_window_of_fourth_order_agrees_with_the_raw_one_at_half_the_noise(
    left_volume: dict[str, Curve],
) -> None:
    curve = left_volume["lv_volume"]
    raw, smooth = VolumeFeatures()(curve), VolumeFeatures(window=9, order=4)(curve)
    assert list(smooth.values()) == pytest.approx(list(raw.values()), rel=0.035)

"""A comparison survives its file to the last bit."""

from dataclasses import fields
from pathlib import Path

import numpy as np

from heartfit.io.noise_models import read_comparison, write_comparison
from heartfit.io.results import read_fingerprint
from heartfit.observation.comparison import Comparison
from heartfit.observation.curve import Curve
from heartfit.observation.operator import Pair, Reading, VolumeFeatures


def reading(scale: float) -> Reading:
    times = np.arange(12) * 0.8 / 12
    curve = Curve(times, (120.0 + scale * 50.0 * np.cos(2.0 * np.pi * times / 0.8)) * 1e-6, 0.8)
    return Reading.from_curves({"lv_volume": curve}, {"lv_volume": VolumeFeatures(frames=12)})


def test_a_comparison_round_trip(tmp_path: Path) -> None:
    random = np.random.default_rng(0)
    strain = random.standard_normal((2, 12, 3, 16))
    error, folded = 1e-3 * random.random((12, 2)), np.arange(12)
    comparison = Comparison(Pair(reading(1.0), reading(0.9)), strain[0], strain[1], error, error[3], folded)
    write_comparison(tmp_path / "1.json", comparison, "abc")
    restored = read_comparison(tmp_path / "1.json")

    for name in {field.name for field in fields(Comparison)} - {"pair"}:
        assert np.array_equal(getattr(restored, name), getattr(comparison, name)), name
    for one, other in (
        (restored.pair.true, comparison.pair.true),
        (restored.pair.measured, comparison.pair.measured),
    ):
        assert one.observations == other.observations
        assert np.array_equal(one.curves["lv_volume"].values, other.curves["lv_volume"].values)
        assert one.curves["lv_volume"].period == 0.8
    assert read_fingerprint(tmp_path / "1.json") == "abc"

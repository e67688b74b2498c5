"""A noise model survives its file to the last bit, and a stored one serves where it applies."""

import json
from pathlib import Path

import numpy as np
import pytest

from heartfit.io.configuration import read_study
from heartfit.io.noise_models import (
    read_noise_model,
    read_sensors,
    stored_noise_model,
    write_noise_model,
    write_sensors,
)
from heartfit.io.results import read_fingerprint
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.scatter import Scatter

ROOT = Path(__file__).parents[2]
DEFAULT = ROOT / "config" / "config.yaml"


def require_same(one: Scatter, other: Scatter) -> None:
    assert (one.names, one.count) == (other.names, other.count)
    assert np.array_equal(one.mean, other.mean)
    assert np.array_equal(one.covariance, other.covariance)


def test_a_noise_model_round_trip(tmp_path: Path) -> None:
    sample = np.random.default_rng(0).standard_normal((24, 25))
    protocol = {"snr": 30.0, "slices": 9, "method": "demons", "breath_hold": True}
    model = NoiseModel(
        protocol,
        Scatter.from_sample(("V_min", "q_max", "q_min"), 0.1 * sample[:, :3]),
        {"rv_volume": Scatter.from_sample([f"phase {k} of 25" for k in range(25)], sample, shrunk=True)},
    )
    write_noise_model(tmp_path / "model.json", model, "abc")
    restored = read_noise_model(tmp_path / "model.json")
    assert restored.protocol == protocol
    require_same(restored.observations, model.observations)
    require_same(restored.curves["rv_volume"], model.curves["rv_volume"])
    assert read_fingerprint(tmp_path / "model.json") == "abc"


@pytest.mark.parametrize(
    ("changes", "file"),
    [
        ({}, "resources/noise_model.json"),
        ({"methods": True}, None),
        ({"cohort": {"scanner": {"voxel": 0.003}}}, None),
        ({"registration": {"knots": 0.016}}, None),
        ({"registration_error": {"noise_model": None}}, None),
    ],
)
def test_the_stored_noise_model_serves_images_of_its_protocol(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, changes: dict, file: str | None
) -> None:
    monkeypatch.chdir(ROOT)
    Path(tmp_path, "changes.yaml").write_text(json.dumps(changes))
    assert stored_noise_model(read_study([DEFAULT, tmp_path / "changes.yaml"])) == file


def test_the_sensors_round_trip(tmp_path: Path) -> None:
    sample = np.random.default_rng(0).standard_normal((24, 3))
    sensors = Scatter.from_sample(("shrinkage", "smoothing", "delay"), sample)
    write_sensors(tmp_path / "sensors.json", sensors, "abc")
    require_same(read_sensors(tmp_path / "sensors.json"), sensors)

"""Noise models, and what sequences of known truth tell of the sensors, as JSON; read back exactly."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from heartfit.io.results import read_result, write_result
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.scatter import Scatter

UNITS = {
    "observations": "V_min, P_max: (measured - true) / measured range; rates: ln(measured / true)",
    "curve": "(measured - true) / measured stroke volume",
}


def write_noise_model(path: Path, model: NoiseModel, fingerprint: str) -> None:
    write_result(path, {"noise_model": model}, fingerprint, UNITS)


def read_noise_model(path: Path) -> NoiseModel:
    """Reads what write_noise_model wrote; raises InputError for a missing or broken file."""
    content = read_result(path)["noise_model"]
    return NoiseModel(content["protocol"], *(_scatter(content[name]) for name in ("observations", "curve")))


def write_sensors(path: Path, sensors: Scatter, fingerprint: str) -> None:
    """Writes the scatter of the image sensors' parameters."""
    write_result(path, {"sensors": sensors}, fingerprint, {"sensors": "SI"})


def read_sensors(path: Path) -> Scatter:
    """Reads what write_sensors wrote; raises InputError for a missing or broken file."""
    return _scatter(read_result(path)["sensors"])


def _scatter(content: Mapping[str, Any]) -> Scatter:
    mean, covariance = np.array(content["mean"]), np.array(content["covariance"])
    return Scatter(tuple(content["names"]), content["count"], mean, covariance)

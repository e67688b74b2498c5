"""A noise model and the image sensors as tables."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from heartfit.observation.coverage import Share
from heartfit.observation.noise_model import EXTREMA, NoiseModel
from heartfit.observation.scatter import Scatter

SENSORS = {
    "shrinkage": ("shrinkage (%)", 0.01),
    "smoothing": ("smoothing (ms)", 1e-3),
    "delay": ("delay (ms)", 1e-3),
}
"""Printed name and SI value of one printed unit."""


def noise_model_table(model: NoiseModel, shares: Mapping[str, Share]) -> pd.DataFrame:
    """One row per observation, one for the LV volume: bias and deviation, and how often the intervals are right.

    bias (median) and deviation in percent: of a rate over its true value, of V_min and the volume over the measured
    stroke volume, as the model has them (P_max: over the range of pressure). The volume's row is the phase of the
    largest deviation, though its cover is that of all; "covered": fresh sequences whose truth lies in
    the 95 % interval, with the exact interval of that share (`heartfit.observation.coverage`).
    """
    worst = int(model.curve.sd.argmax())
    scatter = model.observations
    bias = np.where([name in EXTREMA for name in scatter.names], scatter.mean, np.expm1(scatter.mean))
    rows = [
        _row(name, mean, sd, shares[name])
        for name, mean, sd in zip(scatter.names, bias, scatter.sd, strict=True)
    ]
    volume = f"LV volume, {model.curve.names[worst]}"
    rows.append(_row(volume, model.curve.mean[worst], model.curve.sd[worst], shares["lv_volume"]))
    return pd.DataFrame(rows)


def sensor_table(sensors: Scatter) -> pd.DataFrame:
    """Mean and standard deviation over the sequences of what fits the image sensors."""
    printed = [SENSORS[name] for name in sensors.names]
    units = np.array([unit for _, unit in printed])
    names = [name for name, _ in printed]
    return pd.DataFrame({"sensor": names, "mean": sensors.mean / units, "sd": sensors.sd / units})


def _row(name: str, bias: float, sd: float, share: Share) -> dict[str, Any]:
    return {
        "observation": name,
        "bias (%)": 100.0 * bias,
        "sd (%)": 100.0 * sd,
        "covered (%)": 100.0 * share.covered,
        "covered, low (%)": 100.0 * share.low,
        "covered, high (%)": 100.0 * share.high,
        "fresh sequences": share.sequences,
    }

"""Beliefs and curves of all cases as tidy tables: one number a row, its unit beside it, SI."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np
import pandas as pd

from heartfit.exchange.calibrated import Calibrated
from heartfit.exchange.inference_data import UNITS

BAND = 1.959964
"""Standard deviations within which 95 % of a Gaussian lie."""


def parameters_table(found: Sequence[Calibrated]) -> pd.DataFrame:
    """Median and 95 % interval of each parameter before and after, and the standard deviation of its logarithm."""
    return pd.DataFrame([row for each in found for row in _beliefs(each)])


def curves_table(found: Sequence[Calibrated]) -> pd.DataFrame:
    """Every sample of the measured curves and of the calibrated ones."""
    return pd.DataFrame([row for each in found for row in _samples(each)])


def _beliefs(found: Calibrated) -> Iterator[dict[str, Any]]:
    for about, belief in found.beliefs.items():
        for name, mean, sd in zip(belief.names, belief.mean, belief.sd, strict=True):
            median, low, high = np.exp(mean + BAND * sd * np.array([0.0, -1.0, 1.0]))
            value = {"median": median, "low": low, "high": high, "sd_of_ln": sd}
            yield _key(found) | {"belief": about, "parameter": name, **value, "unit": found.case.units[name]}


def _samples(found: Calibrated) -> Iterable[dict[str, Any]]:
    for about, curves in (("measured", found.measured), ("calibrated", found.simulated)):
        for name, curve in curves.items():
            unit = UNITS[name.rsplit("_", 1)[1]]
            for time, value in zip(curve.times, curve.values, strict=True):
                row = {"kind": about, "curve": name, "time_s": time, "value": value, "unit": unit}
                yield _key(found) | row


def _key(found: Calibrated) -> dict[str, Any]:
    return {"case": found.case.case, "setting": found.case.setting}

"""The sensitivities of one setting, parameter by parameter."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from heartfit.sensitivity.covariance import Sensitivity
from heartfit.tables.display import printed, printed_unit

VOLUME = ("V_min", "q_max", "q_min")


def sensitivity_table(found: Sensitivity, units: Mapping[str, str]) -> pd.DataFrame:
    """One row per parameter: prior, normalised Cov(X, Z) by observation, and the share of its squares.

    "volume (%)": of the three observations of the volume curve, "all (%)": of all; a column adds up to 100.
    """
    squares = [100 * _share(found.of(names)) for names in (VOLUME, found.observations)]
    median = found.prior.physical()
    return pd.DataFrame(
        [
            {
                "parameter": name,
                "unit": printed_unit(units[name]),
                "mean": printed(median[name], units[name]),
                "sd (%)": 100 * found.prior.sd[i],
                **dict(zip(found.observations, found.covariance[i].tolist(), strict=True)),
                "volume (%)": squares[0][i],
                "all (%)": squares[1][i],
            }
            for i, name in enumerate(found.parameters)
        ]
    )


def _share(covariance: np.ndarray) -> Any:
    squares = (covariance**2).sum(axis=1)
    return squares / squares.sum()


def bulk_modulus_table(found: Mapping[str, Sensitivity], units: Mapping[str, str]) -> pd.DataFrame:
    """By setting, the per cent by which each observation changes with one per cent of K: d ln Z / d ln K.

    A sphere with an incompressible wall has zero in every column.
    """
    rows = [
        {
            "setting": setting,
            f"K ({printed_unit(units['K'])})": printed(each.prior.physical()["K"], units["K"]),
            **dict(zip(each.observations, each.slopes[each.parameters.index("K")].tolist(), strict=True)),
        }
        for setting, each in found.items()
        if "K" in each.parameters
    ]
    return pd.DataFrame(rows)

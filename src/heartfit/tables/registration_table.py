"""What registration costs: section 4.3 of the paper as tables, by acquisition and by segment.

References
----------
Marchesseau et al. 2012, section 4.3: about 25 % on both slopes. Tobon-Gomez C et al. 2013,
doi 10.1016/j.media.2013.03.008: errors of tracked landmarks in volunteers.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from heartfit.geometry.arrays import Floats
from heartfit.observation.comparison import Comparison
from heartfit.observation.strain import DIRECTIONS, SEGMENTS
from heartfit.tables.acquisitions import Acquisitions, percent_errors, strain_errors
from heartfit.tables.errors_table import PAPER

SLOPE_ERROR = 25.0
"""The paper's, percent."""
TRACKING_ERROR = "1.5 to 2.1"
"""Of published methods, mm."""
NO_COUNTS = {"sequences": "", "folded": ""}
TOBON_GOMEZ = "Tobon-Gomez et al. 2013"


def registration_table(acquisitions: Acquisitions) -> pd.DataFrame:
    """One row per protocol, then what was published.

    Of each observation the mean over the sequences of the unsigned error, and of the signed one ("bias", negative where
    its size is underestimated), %; of the strains at end systole the root mean square over sequences and segments, in
    percent strain; of the points the mean and the mean of the 95th percentiles of the sequences, over the beat and at
    end systole, mm; the most folded tetrahedra in any frame.
    """
    rows = [_row(label, comparisons) for label, comparisons in acquisitions.rows().items()]
    paper = {"acquisition": PAPER, **NO_COUNTS, "q_max (%)": SLOPE_ERROR, "q_min (%)": SLOPE_ERROR}
    tracked = {"acquisition": TOBON_GOMEZ, **NO_COUNTS, "points (mm)": TRACKING_ERROR}
    return pd.DataFrame([*rows, paper, tracked])


def segment_table(comparisons: Sequence[Comparison]) -> pd.DataFrame:
    """One row per AHA segment: at end systole the true strain, mean over the sequences, and what was registered of it.

    "bias" is the mean of registered less true, "RMS" its root mean square, in percent strain like the strain itself.
    """
    true = 100.0 * np.array([each.true_strain[each.end_systole] for each in comparisons])
    error = strain_errors(comparisons)
    table: dict[str, Any] = {"segment": SEGMENTS}
    for index, direction in enumerate(DIRECTIONS):
        table[f"{direction} (%)"] = true[:, index].mean(axis=0)
        table[f"{direction} bias (%)"] = error[:, index].mean(axis=0)
        table[f"{direction} RMS (%)"] = root_mean_square(error[:, index], axis=0)
    return pd.DataFrame(table)


def root_mean_square(values: Floats, axis: int | None = None) -> Floats:
    """sqrt(mean(x^2))."""
    return np.sqrt(np.mean(np.square(values), axis=axis))


def _row(label: str, comparisons: Sequence[Comparison]) -> dict[str, Any]:
    row: dict[str, Any] = {"acquisition": label, "sequences": len(comparisons)}
    for name, errors in percent_errors(comparisons).items():
        row |= {f"{name} (%)": np.abs(errors).mean(), f"{name} bias (%)": errors.mean()}
    strain = strain_errors(comparisons)
    row |= {
        f"{direction} (%)": float(root_mean_square(strain[:, index]))
        for index, direction in enumerate(DIRECTIONS)
    }
    beat = 1e3 * np.mean([each.point_error_of_beat for each in comparisons], axis=0)
    late = 1e3 * np.mean([each.point_error[each.end_systole] for each in comparisons], axis=0)
    row |= {"points (mm)": beat[0], "points 95th (mm)": beat[1]}
    row |= {"ES points (mm)": late[0], "ES points 95th (mm)": late[1]}
    return row | {"folded": max(int(each.folded.max()) for each in comparisons)}

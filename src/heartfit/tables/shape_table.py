"""The shape of a motion over the beat, and what became of it at end systole beside what is measured in health.

References
----------
Stoylen A et al. 2018, doi 10.1111/echo.13825: descent of the mitral ring 15.8 (sd 2.5) mm, 16.3 (2.4) % of the length
of the wall, in 1266 adults. Lorenz CH et al. 2000, Delineation of normal human left ventricular twist, J Cardiovasc
Magn Reson 2: twist 12.6 (1.5) degrees in ten; Young AA, Cowan BR 2012, doi 10.1186/1532-429X-14-49: about 13.
"""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from heartfit.beat import Beat, motion_of
from heartfit.geometry.mesh import VentricularMesh
from heartfit.observation.shape import Shape, shape_of
from heartfit.observation.walls import walls_of
from heartfit.tables.walls_table import WALL_COLUMNS, walls_table

COLUMNS = {  # column of a curve: what one printed unit is in SI
    "shortening (%)": ("shortening", 0.01),
    "descent of the base (mm)": ("descent", 1e-3),
    "rise of the apex (mm)": ("rise", 1e-3),
    "free wall inward (mm)": ("inward", 1e-3),
    "thickening (%)": ("thickening", 0.01),
    "twist (degrees)": ("twist", np.deg2rad(1.0)),
    "LV volume (mL)": ("cavity", 1e-6),
}
SPREAD = ("element volume, 1st percentile", "element volume, median", "element volume, 99th percentile")
HEALTHY = {
    "shortening (%)": "16.3 ± 2.4",
    "descent of the base (mm)": "15.8 ± 2.5",
    "twist (degrees)": "12.6 ± 1.5",
}


def shape_table(shape: Shape) -> pd.DataFrame:
    """One row per phase, in time: every curve of the shape in the unit its column prints."""
    table = {"time (s)": shape.times}
    table |= {column: getattr(shape, name) / unit for column, (name, unit) in COLUMNS.items()}
    return pd.DataFrame(table | dict(zip(SPREAD, shape.volume.T, strict=True)))


def beat_shape_table(mesh: VentricularMesh, beat: Beat) -> pd.DataFrame:
    """The same of a beat of the ventricles ``mesh`` that kept its nodes, with its walls; no rows if the beat failed."""
    if not beat.completed:
        return pd.DataFrame(columns=["time (s)", *COLUMNS, *SPREAD, *WALL_COLUMNS])
    motion = motion_of(beat)
    return shape_table(shape_of(mesh, motion)).join(walls_table(walls_of(mesh, motion)))


def end_systole(shapes: Mapping[str, pd.DataFrame]) -> pd.DataFrame:
    """One row per quantity, one column per motion, where its left ventricle is smallest; "" of a failed beat."""
    found = {name: _at_least_volume(shape) for name, shape in shapes.items()}
    rows = ["time (s)", *COLUMNS, *SPREAD]
    table = {"at end systole": rows} | {
        name: [values.get(row) for row in rows] for name, values in found.items()
    }
    return pd.DataFrame(table | {"healthy adults": [HEALTHY.get(row, "") for row in rows]})


def _at_least_volume(shape: pd.DataFrame) -> dict[str, float]:
    return {} if shape.empty else dict(shape.loc[shape["LV volume (mL)"].idxmin()])

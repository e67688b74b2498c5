"""Shape of a motion over the beat and of its walls as tables, and its values at end systole with those in health.

Sources: Stoylen A et al. 2018, doi 10.1111/echo.13825: descent of the mitral ring 15.8 (sd 2.5) mm, 16.3 (2.4) % of the
length of the wall, in 1266 adults. Lorenz CH et al. 2000, Delineation of normal human left ventricular twist, J
Cardiovasc Magn Reson 2: twist 12.6 (1.5) degrees in ten; Young AA, Cowan BR 2012, doi 10.1186/1532-429X-14-49: about
13.
"""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import Beat, nodal_motion
from heartfit.observation.shape import Shape, motion_shape
from heartfit.observation.strain import WallMotion, wall_motion

COLUMNS = {  # column: attribute of the curve, SI value of the printed unit
    "shortening (%)": ("shortening", 0.01),
    "descent of the base (mm)": ("descent", 1e-3),
    "rise of the apex (mm)": ("rise", 1e-3),
    "free wall inward (mm)": ("inward", 1e-3),
    "thickening (%)": ("thickening", 0.01),
    "twist (degrees)": ("twist", np.deg2rad(1.0)),
    "LV volume (mL)": ("cavity", 1e-6),
}
VOLUME_COLUMNS = (
    "element volume, 1st percentile",
    "element volume, median",
    "element volume, 99th percentile",
)
HEALTHY = {
    "shortening (%)": "16.3 ± 2.4",
    "descent of the base (mm)": "15.8 ± 2.5",
    "twist (degrees)": "12.6 ± 1.5",
}
WALL_COLUMNS = {  # column: attribute of the curve, SI value of the printed unit
    "septum inward (mm)": ("septal", 1e-3),
    "lateral wall inward (mm)": ("lateral", 1e-3),
    "septal strain (%)": ("septal_strain", 0.01),
    "lateral strain (%)": ("lateral_strain", 0.01),
}


def shape_table(shape: Shape) -> pd.DataFrame:
    """Return one row per time: curves of the shape in the units of the columns."""
    table = {"time (s)": shape.times}
    table |= {column: getattr(shape, name) / unit for column, (name, unit) in COLUMNS.items()}
    return pd.DataFrame(table | dict(zip(VOLUME_COLUMNS, shape.volume.T, strict=True)))


def walls_table(walls: WallMotion) -> pd.DataFrame:
    """Return one row per time: curves of the walls."""
    return pd.DataFrame(
        {column: getattr(walls, name) / unit for column, (name, unit) in WALL_COLUMNS.items()}
    )


def beat_shape_table(mesh: VentricularMesh, beat: Beat) -> pd.DataFrame:
    """Return shape and walls of a beat of the ventricles ``mesh``; no rows if the beat failed."""
    if not beat.completed:
        return pd.DataFrame(columns=["time (s)", *COLUMNS, *VOLUME_COLUMNS, *WALL_COLUMNS])
    motion = nodal_motion(beat)
    return shape_table(motion_shape(mesh, motion)).join(walls_table(wall_motion(mesh, motion)))


def end_systole_table(shapes: Mapping[str, pd.DataFrame]) -> pd.DataFrame:
    """Return one row per quantity, one column per motion, at its least left volume; empty cells for a failed beat."""
    values_by_motion = {name: _at_least_volume(shape) for name, shape in shapes.items()}
    rows = ["time (s)", *COLUMNS, *VOLUME_COLUMNS]
    table = {"at end systole": rows} | {
        name: [values.get(row) for row in rows] for name, values in values_by_motion.items()
    }
    return pd.DataFrame(table | {"healthy adults": [HEALTHY.get(row, "") for row in rows]})


def _at_least_volume(shape: pd.DataFrame) -> dict[str, float]:
    return {} if shape.empty else dict(shape.loc[shape["LV volume (mL)"].idxmin()])

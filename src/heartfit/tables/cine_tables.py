"""What registration makes of real short-axis images, beside the measured surface cut by the same planes."""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from heartfit.observation.cine import CineComparison
from heartfit.observation.curve import Curve
from heartfit.observation.operator import VolumeFeatures
from heartfit.observation.outlines import Outline
from heartfit.observation.wall_points import WallPoints

NAMES = {"lv_endo": "LV endocardium", "rv_endo": "RV endocardium", "epi": "epicardium"}
SQUARE_CENTIMETRE, MILLIMETRE, MILLILITRE = 1e-4, 1e-3, 1e-6


def outline_table(cine: CineComparison) -> pd.DataFrame:
    """One row per outline and slice; nothing where the measured outline is not whole, such as above the valves.

    Areas are the measured ones; their errors, registered less measured, are in percent of the area at end diastole, so
    that an apex that leaves its slice does not divide by nothing. Distances are means along both outlines, averaged
    over the frames after the first, as is the 95th percentile of each frame; "unmoved" is what the outline of end
    diastole itself is off by.
    """
    return pd.DataFrame([_outline_row(outline, cine.end_systole) for outline in cine.outlines])


def _outline_row(outline: Outline, end_systole: int) -> dict[str, object]:
    later = outline.frames[outline.frames > 0]
    area = outline.measured_area
    error = 100.0 * (outline.carried_area - area) / area[0]
    mean, far = (distance / MILLIMETRE for distance in outline.distance())
    return {
        "outline": NAMES[outline.surface],
        "slice": outline.slice,
        "frames": len(later),
        "ED (cm^2)": area[0] / SQUARE_CENTIMETRE,
        "ES (cm^2)": area[end_systole] / SQUARE_CENTIMETRE,
        "error ES (% of ED)": error[end_systole],
        "error RMS (% of ED)": float(np.sqrt((error[later] ** 2).mean())),
        "distance ES (mm)": mean[end_systole],
        "distance (mm)": float(mean[later].mean()),
        "distance 95 % (mm)": float(far[later].mean()),
        "unmoved (mm)": float(outline.distance_at_rest()[later].mean() / MILLIMETRE),
    }


def wall_table(cine: CineComparison) -> pd.DataFrame:
    """One row per slice: how far points followed in the plane are from the measured surface's own, mm.

    In the plane: mean over the points at end systole, over them and all frames after the first, and the 95th
    percentile; outwards: the signed part across the wall. Then how far the measured points have moved in the plane, and
    through it towards higher slices, which registration in the plane cannot see.
    """
    return pd.DataFrame([_wall_row(wall, cine.end_systole) for wall in cine.walls])


def _wall_row(wall: WallPoints, end_systole: int) -> dict[str, object]:
    apart = wall.in_plane()[1:] / MILLIMETRE
    through = wall.through_plane()[end_systole] / MILLIMETRE
    path = np.linalg.norm((wall.measured[end_systole] - wall.measured[0]) / MILLIMETRE, axis=1)
    return {
        "slice": wall.slice,
        "points": apart.shape[1],
        "ES (mm)": float(apart[end_systole - 1].mean()),
        "beat (mm)": float(apart.mean()),
        "95 % (mm)": float(np.quantile(apart, 0.95)),
        "outwards ES (mm)": float(wall.across()[end_systole].mean() / MILLIMETRE),
        "motion in plane ES (mm)": float(np.sqrt(np.maximum(path**2 - through**2, 0.0)).mean()),
        "motion through plane ES (mm)": float(through.mean()),
    }


def short_axis_volume_table(volumes: Mapping[str, Curve]) -> pd.DataFrame:
    """One row per way to the left ventricle's volume, see heartfit.observation.short_axis_volume.

    Largest and smallest volume, ejection fraction, the rates that the calibration observes, and the root mean square
    over the beat of the difference from the surface's volume.
    """
    return pd.DataFrame([_volume_row(name, curve, volumes["surface"]) for name, curve in volumes.items()])


def _volume_row(name: str, curve: Curve, surface: Curve) -> dict[str, object]:
    largest, smallest = curve.values.max() / MILLILITRE, curve.values.min() / MILLILITRE
    rates = VolumeFeatures()(curve)
    return {
        "volume": name,
        "EDV (mL)": largest,
        "ESV (mL)": smallest,
        "EF (%)": 100.0 * (1.0 - smallest / largest),
        "q_max (mL/s)": rates["q_max"] / MILLILITRE,
        "q_min (mL/s)": rates["q_min"] / MILLILITRE,
        "RMS (mL)": float(np.sqrt(((curve.values - surface.values) ** 2).mean()) / MILLILITRE),
    }

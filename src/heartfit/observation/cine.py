"""Left ventricular volume from short-axis slices (modified Simpson rule), registered against measured surface."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.sections import cut_surface, enclosed_area
from heartfit.geometry.surface import LabelledSurface
from heartfit.imaging.registration.slices import SliceMotion
from heartfit.imaging.sequence import Grid
from heartfit.observation.curve import Curve
from heartfit.observation.outlines import Outline, WallPoints, outlines, slice_plane, wall_points


def modified_simpson(areas: Floats, step: float, apical: Floats, basal: Floats) -> Floats:
    """Volume (...) [m^3] from the areas (..., k) [m^2] of parallel slices from apex to base, ``step`` [m] apart.

    V = h (A_1/2 + A_2 + ... + A_{m-1} + A_m/2) + 2/3 a A_1 + b A_m. apical (...): length a [m] from the first slice
    to the apex, a half-ellipsoid; basal (...): length b [m] from the last slice to the valve plane, a cylinder.
    """
    central = step * (areas.sum(axis=-1) - 0.5 * (areas[..., 0] + areas[..., -1]))
    volume: Floats = central + 2.0 / 3.0 * apical * areas[..., 0] + basal * areas[..., -1]
    return volume


def left_ventricular_volumes(
    surface: LabelledSurface, positions: Floats, grid: Grid, contours: list[Outline]
) -> dict[str, Floats]:
    """Left ventricular volume (p,) [m^3] in four ways, which separate the steps from the surface to the images.

    "surface": enclosed by the measured surface (positions (p, n, 3) [m]); "cut": by Simpson's rule from the cuts of the
    surface, with its ends in each frame; "registered": from the carried outlines, with the same ends;
    "registered, ends at rest": likewise, with the ends of the first frame, as images of slices alone would give it.
    """
    cavity, step = Cavity.from_endocardium(surface, "lv_endo"), float(grid.spacing[2])
    heights = np.array([grid.index(points)[:, 2] for points in positions])
    nodes = np.unique(surface.surfaces["lv_endo"])
    basewards = np.sign(heights[0, cavity.rim].mean() - heights[0, nodes].mean())
    left = sorted(
        (outline for outline in contours if outline.surface == "lv_endo"),
        key=lambda outline: outline.slice * basewards,
    )
    first, last = basewards * left[0].slice, basewards * left[-1].slice
    apical = step * np.maximum(first - (basewards * heights[:, nodes]).min(axis=1), 0.0)
    basal = step * np.maximum((basewards * heights[:, cavity.rim]).mean(axis=1) - last, 0.0)
    cuts = np.array(
        [[_cut_area(cavity, points, grid, outline.slice) for outline in left] for points in positions]
    )
    carried = np.stack([outline.carried_area for outline in left], axis=1)
    return {
        "surface": np.array([cavity.volume(points) for points in positions]),
        "cut": modified_simpson(cuts, step, apical, basal),
        "registered": modified_simpson(carried, step, apical, basal),
        "registered, ends at rest": modified_simpson(carried, step, apical[:1], basal[:1]),
    }


def _cut_area(cavity: Cavity, points: Floats, grid: Grid, k: int) -> float:
    """Area [m^2] in which slice k cuts the cavity, its valves closed."""
    origin, normal = slice_plane(grid, k)
    segments = cut_surface(cavity.corners(points), cavity.triangles, origin, normal)
    return float(np.abs(enclosed_area(segments, normal))) if len(segments) else 0.0


@dataclass(frozen=True, eq=False)
class CineComparison:
    """Registered motion of short-axis images against the measured surface.

    outlines: one for each surface and slice; walls: points of the wall in each slice that holds the left ventricle;
    volumes: curves of `left_ventricular_volumes`; end_systole: the frame of the smallest volume of the surface.
    """

    outlines: list[Outline]
    walls: list[WallPoints]
    volumes: Mapping[str, Curve]
    end_systole: int


def compare_cine(
    surface: LabelledSurface, positions: Floats, times: Floats, period: float, motion: SliceMotion
) -> CineComparison:
    """Compare outlines, wall points and volumes of registered slices with the measured surface.

    surface: measured in the first frame; positions (p, n, 3) [m]: its points in the frames of the motion; times (p,)
    [s]; period [s]. Raises InputError if the numbers of frames differ, and if no slice cuts the left ventricle below
    its valves.
    """
    if len(positions) != len(motion.displacement):
        raise InputError(
            f"cine: {len(motion.displacement)} frames, {len(positions)} phases of the measured surface; "
            "expected one for each: register the images that the surface was fitted to"
        )
    contours = outlines(surface, positions, motion)
    slices = [outline.slice for outline in contours if outline.surface == "lv_endo"]
    if not slices:
        raise InputError(
            "cine: no slice cuts the left ventricle below its valves; "
            "expected short-axis images of the measured heart in the same coordinates"
        )
    walls = [wall_points(surface, positions, motion, k) for k in slices]
    volumes = left_ventricular_volumes(surface, positions, motion.grid, contours)
    curves = {name: Curve.of_volume(times, values, period) for name, values in volumes.items()}
    return CineComparison(contours, walls, curves, int(volumes["surface"].argmin()))

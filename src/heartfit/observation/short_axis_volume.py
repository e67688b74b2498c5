"""The volume of the left ventricle from the areas of its short-axis slices, by the modified Simpson rule."""

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.contours import enclosed_area
from heartfit.geometry.cut import cut
from heartfit.geometry.surface import LabelledSurface
from heartfit.imaging.grid import Grid
from heartfit.observation.outlines import Outline, plane


def modified_simpson(areas: Floats, step: float, apical: Floats, basal: Floats) -> Floats:
    """Volume (...) in m^3 from the areas (...,k) m^2 of parallel slices from apex to base, step m apart.

    V = h (A_1/2 + A_2 + ... + A_{m-1} + A_m/2) + 2/3 a A_1 + b A_m. apical (...) a, m: from the first slice to the
    apex, a half-ellipsoid; basal (...) b, m: from the last slice to the valve plane, a cylinder.
    """
    between = step * (areas.sum(axis=-1) - 0.5 * (areas[..., 0] + areas[..., -1]))
    volume: Floats = between + 2.0 / 3.0 * apical * areas[..., 0] + basal * areas[..., -1]
    return volume


def left_volumes(
    surface: LabelledSurface, positions: Floats, grid: Grid, found: list[Outline]
) -> dict[str, Floats]:
    """Left ventricular volume (p,) m^3, four times: what each step from the surface to the images does to it.

    "surface": enclosed by the measured surface (positions (p,n,3) m); "cut": by Simpson's rule from the surface's cuts,
    ends where the surface has them in each frame; "registered": from the carried outlines, with the same ends;
    "registered, ends at rest": likewise, with the ends of the first frame, as images of slices alone would give it.
    """
    cavity, step = Cavity.of(surface, "lv_endo"), float(grid.spacing[2])
    heights = np.array([grid.index(points)[:, 2] for points in positions])
    nodes = np.unique(surface.surfaces["lv_endo"])
    basewards = np.sign(heights[0, cavity.rim].mean() - heights[0, nodes].mean())
    left = sorted(
        (outline for outline in found if outline.surface == "lv_endo"),
        key=lambda each: each.slice * basewards,
    )
    first, last = basewards * left[0].slice, basewards * left[-1].slice
    apical = step * np.maximum(first - (basewards * heights[:, nodes]).min(axis=1), 0.0)
    basal = step * np.maximum((basewards * heights[:, cavity.rim]).mean(axis=1) - last, 0.0)
    cuts = np.array([[_area(cavity, points, grid, each.slice) for each in left] for points in positions])
    carried = np.stack([outline.carried_area for outline in left], axis=1)
    return {
        "surface": np.array([cavity.volume(points) for points in positions]),
        "cut": modified_simpson(cuts, step, apical, basal),
        "registered": modified_simpson(carried, step, apical, basal),
        "registered, ends at rest": modified_simpson(carried, step, apical[:1], basal[:1]),
    }


def _area(cavity: Cavity, points: Floats, grid: Grid, k: int) -> float:
    """Area in m^2 in which slice k cuts the cavity, its valves closed."""
    origin, normal = plane(grid, k)
    segments = cut(cavity.corners(points), cavity.triangles, origin, normal)
    return float(np.abs(enclosed_area(segments, normal))) if len(segments) else 0.0

"""Outlines of the heart in short-axis slices: carried by registration, and as the measured surface is cut."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.contours import contour_distances, enclosed_area, weighted_quantile
from heartfit.geometry.cut import cut
from heartfit.geometry.surface import LabelledSurface
from heartfit.geometry.topology import rim_edges
from heartfit.imaging.grid import Grid
from heartfit.registration.slices import SliceMotion

OUTLINED = ("lv_endo", "rv_endo", "epi")


@dataclass(frozen=True, eq=False)
class Outline:
    """One outline of the heart in one slice over the beat.

    surface: its name; slice; normal (3,) of the plane; carried (p,s,2,3) m: the segments of the first frame, carried
    by registration; measured: the segments (t,2,3) m of the measured surface, cut by the same plane in each frame;
    whole (p,): whether the measured one is closed, that is the plane meets the surface and all of its valve rings lie
    on one side. Only then can the two be compared.
    """

    surface: str
    slice: int
    normal: Floats
    carried: Floats
    measured: tuple[Floats, ...]
    whole: NDArray[np.bool_]

    @property
    def frames(self) -> Integers:
        """The frames (f,) in which the outlines can be compared."""
        return np.flatnonzero(self.whole)

    @cached_property
    def carried_area(self) -> Floats:
        """Area (p,) in m^2 inside the carried outline."""
        return np.abs(enclosed_area(self.carried, self.normal))

    @cached_property
    def measured_area(self) -> Floats:
        """Area (p,) in m^2 inside the measured outline, NaN where it is not whole."""
        areas = [
            np.abs(enclosed_area(segments, self.normal)) if whole else np.nan
            for segments, whole in zip(self.measured, self.whole, strict=True)
        ]
        return np.array(areas)

    def distance(self) -> tuple[Floats, Floats]:
        """Mean and 95th percentile (p,) in m of the distance between the outlines, NaN where not comparable."""
        return self._distance(self.carried)

    def distance_at_rest(self) -> Floats:
        """The mean distance (p,) in m if nothing had moved: what registration has to make up for."""
        return self._distance(np.broadcast_to(self.carried[0], self.carried.shape))[0]

    def _distance(self, carried: Floats) -> tuple[Floats, Floats]:
        found = np.full((2, len(carried)), np.nan)
        for frame in self.frames:
            distances, weights = contour_distances(carried[frame], self.measured[frame])
            found[:, frame] = distances @ weights, weighted_quantile(distances, weights, 0.95)
        return found[0], found[1]


def outlines(surface: LabelledSurface, positions: Floats, motion: SliceMotion) -> list[Outline]:
    """Every outline that is whole in the first frame: for each of OUTLINED, slice by slice.

    surface: the measured surface in the first frame; positions (p,n,3) m: its points in every frame; motion: the
    registered motion of the slices in the same frames.
    """
    found = []
    for name in OUTLINED:
        triangles, rim = surface.surfaces[name], np.unique(rim_edges(surface.surfaces[name]))
        for k in range(motion.grid.size[2]):
            origin, normal = plane(motion.grid, k)
            measured = tuple(cut(points, triangles, origin, normal) for points in positions)
            above = (positions[:, rim] - origin) @ normal > 0.0
            whole = (above.all(axis=1) | ~above.any(axis=1)) & np.array([len(part) > 0 for part in measured])
            if whole[0]:
                found.append(Outline(name, k, normal, _carried(motion, measured[0]), measured, whole))
    return found


def plane(grid: Grid, k: int) -> tuple[Floats, Floats]:
    """A point (3,) m of the plane of slice k and its unit normal (3,)."""
    return grid.points(np.array([0.0, 0.0, k])), grid.direction[:, 2]


def _carried(motion: SliceMotion, segments: Floats) -> Floats:
    places = motion.carry(segments.reshape(-1, 3))
    return places.reshape(len(places), *segments.shape)

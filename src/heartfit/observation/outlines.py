"""Outlines and wall points of the heart in short-axis slices: carried by registration, and of the measured surface."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.carry import nearest_on_surface
from heartfit.geometry.sections import (
    contour_distances,
    cut_surface,
    enclosed_area,
    ray_crossings,
    weighted_quantile,
)
from heartfit.geometry.surface import LabelledSurface, rim_edges
from heartfit.imaging.registration.slices import SliceMotion
from heartfit.imaging.sequence import Grid

OUTLINED_SURFACES = ("lv_endo", "rv_endo", "epi")
RAY_COUNT = 24
"""Rays from the middle of the left ventricle on which the wall points of a slice lie."""


@dataclass(frozen=True, eq=False)
class Outline:
    """Outline of one surface of the heart in one slice over the beat.

    surface: its name; slice: its number; normal (3,) of the plane; carried (p, s, 2, 3) [m]: the segments of the first
    frame, carried by registration; measured: the segments (t, 2, 3) [m] of the measured surface, cut by the same plane
    in each frame; whole (p,): true where the measured outline is closed, that is the plane meets the surface and all
    of its valve rings lie on one side. Only closed outlines can be compared.
    """

    surface: str
    slice: int
    normal: Floats
    carried: Floats
    measured: tuple[Floats, ...]
    whole: NDArray[np.bool_]

    @property
    def frames(self) -> Integers:
        """Frames (f,) in which the outlines can be compared."""
        return np.flatnonzero(self.whole)

    @cached_property
    def carried_area(self) -> Floats:
        """Area (p,) [m^2] inside the carried outline."""
        return np.abs(enclosed_area(self.carried, self.normal))

    @cached_property
    def measured_area(self) -> Floats:
        """Area (p,) [m^2] inside the measured outline, NaN where it is not whole."""
        areas = [
            np.abs(enclosed_area(segments, self.normal)) if whole else np.nan
            for segments, whole in zip(self.measured, self.whole, strict=True)
        ]
        return np.array(areas)

    def distance(self) -> tuple[Floats, Floats]:
        """Mean and 95th percentile (p,) [m] of the distance between the outlines, NaN where not comparable."""
        return self._distance(self.carried)

    def distance_at_rest(self) -> Floats:
        """Mean distance (p,) [m] of the measured outlines from the first carried one: the motion to be registered."""
        return self._distance(np.broadcast_to(self.carried[0], self.carried.shape))[0]

    def _distance(self, carried: Floats) -> tuple[Floats, Floats]:
        summary = np.full((2, len(carried)), np.nan)
        for frame in self.frames:
            distances, weights = contour_distances(carried[frame], self.measured[frame])
            summary[:, frame] = distances @ weights, weighted_quantile(distances, weights, 0.95)
        return summary[0], summary[1]


def outlines(surface: LabelledSurface, positions: Floats, motion: SliceMotion) -> list[Outline]:
    """Every outline that is whole in the first frame, by OUTLINED_SURFACES and slice.

    surface: the measured surface in the first frame; positions (p, n, 3) [m]: its points in every frame; motion: the
    registered motion of the slices in the same frames.
    """
    contours = []
    for name in OUTLINED_SURFACES:
        triangles, rim = surface.surfaces[name], np.unique(rim_edges(surface.surfaces[name]))
        for k in range(motion.grid.size[2]):
            origin, normal = slice_plane(motion.grid, k)
            measured = tuple(cut_surface(points, triangles, origin, normal) for points in positions)
            above = (positions[:, rim] - origin) @ normal > 0.0
            whole = (above.all(axis=1) | ~above.any(axis=1)) & np.array([len(part) > 0 for part in measured])
            if whole[0]:
                contours.append(Outline(name, k, normal, _carried(motion, measured[0]), measured, whole))
    return contours


def slice_plane(grid: Grid, k: int) -> tuple[Floats, Floats]:
    """Point (3,) [m] on the plane of slice k and its unit normal (3,)."""
    return grid.points(np.array([0.0, 0.0, k])), grid.direction[:, 2]


def _carried(motion: SliceMotion, segments: Floats) -> Floats:
    places = motion.carry(segments.reshape(-1, 3))
    return places.reshape(len(places), *segments.shape)


@dataclass(frozen=True, eq=False)
class WallPoints:
    """Points of the wall in one slice over the beat.

    slice: its number; normal (3,) of its plane; carried (p, n, 3) [m]: by registration, in the plane; measured
    (p, n, 3) [m]: the same points of the measured wall, which leave the plane; outwards (n, 3): unit vectors in the
    plane, across the wall.
    """

    slice: int
    normal: Floats
    carried: Floats
    measured: Floats
    outwards: Floats

    def in_plane(self) -> Floats:
        """Distance (p, n) [m] between carried and measured points, projected onto the plane."""
        difference = self.carried - self.measured
        distance: Floats = np.linalg.norm(
            difference - (difference @ self.normal)[..., None] * self.normal, axis=-1
        )
        return distance

    def across(self) -> Floats:
        """Distance (p, n) [m] of the carried point outwards of the measured one; independent of rotation."""
        return np.einsum("pnd,nd->pn", self.carried - self.measured, self.outwards)

    def through_plane(self) -> Floats:
        """Displacement (p, n) [m] of the measured point out of the plane of the slice, along the normal."""
        distance: Floats = (self.measured - self.measured[0]) @ self.normal
        return distance


def wall_points(
    surface: LabelledSurface, positions: Floats, motion: SliceMotion, k: int, depth: float = 0.5
) -> WallPoints:
    """RAY_COUNT points of the wall in slice k, at a relative depth from 0 (endocardium) to 1 (outer side).

    surface: measured in the first frame; positions (p, n, 3) [m]: its points in every frame. Each point lies on a ray
    from the middle of the left ventricle, between the endocardium and the next surface outwards: the right endocardium
    in the septum, else the epicardium. The measured point keeps its relative depth between the material points of the
    two surfaces.
    """
    origin, normal = slice_plane(motion.grid, k)
    axes = motion.grid.direction[:, :2]
    inner, outer = (
        surface.surfaces["lv_endo"],
        np.vstack([surface.surfaces["rv_endo"], surface.surfaces["epi"]]),
    )
    contours = [
        (cut_surface(surface.points, part, origin, normal) - origin) @ axes for part in (inner, outer)
    ]
    centre = contours[0].mean(axis=(0, 1))
    angle = 2.0 * np.pi * np.arange(RAY_COUNT) / RAY_COUNT
    directions = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    lengths = [ray_crossings(contour, centre, directions).min(axis=1) for contour in contours]
    ends = [origin + (centre + length[:, None] * directions) @ axes.T for length in lengths]
    first, last = (
        _follow(end, surface.points, part, positions) for end, part in zip(ends, (inner, outer), strict=True)
    )
    carried = motion.carry((1.0 - depth) * ends[0] + depth * ends[1])
    return WallPoints(k, normal, carried, (1.0 - depth) * first + depth * last, directions @ axes.T)


def _follow(places: Floats, points: Floats, triangles: Integers, positions: Floats) -> Floats:
    """Positions (p, n, 3) in every frame of material points ``places`` (n, 3) on a surface."""
    nearest, weights = nearest_on_surface(places, points, triangles)
    return np.einsum("nc,pncd->pnd", weights, positions[:, triangles[nearest]])

"""Points within the left ventricular wall: followed in the plane by registration, carried by the measured heart."""

from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.contours import ray_crossings
from heartfit.geometry.cut import cut
from heartfit.geometry.nearest import nearest_on_surface
from heartfit.geometry.surface import LabelledSurface
from heartfit.observation.outlines import plane
from heartfit.registration.slices import SliceMotion

ANGLES = 24


@dataclass(frozen=True, eq=False)
class WallPoints:
    """Points of the wall in one slice over the beat.

    slice; normal (3,) of its plane; carried (p,n,3) m by registration, in the plane; measured (p,n,3) m: the same
    points of the measured wall, which leave the plane; outwards (n,3): unit vectors in the plane, across the wall.
    """

    slice: int
    normal: Floats
    carried: Floats
    measured: Floats
    outwards: Floats

    def in_plane(self) -> Floats:
        """Distance (p,n) in m between the two, seen along the normal."""
        apart = self.carried - self.measured
        distance: Floats = np.linalg.norm(apart - (apart @ self.normal)[..., None] * self.normal, axis=-1)
        return distance

    def across(self) -> Floats:
        """How far (p,n), m, the carried point lies outwards of the measured one; no rotation enters it."""
        return np.einsum("pnd,nd->pn", self.carried - self.measured, self.outwards)

    def through_plane(self) -> Floats:
        """How far (p,n), m, the measured point has left the plane of the slice, along the normal."""
        left: Floats = (self.measured - self.measured[0]) @ self.normal
        return left


def wall_points(
    surface: LabelledSurface, positions: Floats, motion: SliceMotion, k: int, depth: float = 0.5
) -> WallPoints:
    """ANGLES points at this depth, 0 at the endocardium and 1 at the outer side, of the wall in slice k.

    surface: measured in the first frame; positions (p,n,3) m: its points in every frame. Each point lies on a ray from
    the middle of the left ventricle, between the endocardium and the next surface outwards: the right endocardium in
    the septum, else the epicardium. The measured point keeps its share between the material points of the two.
    """
    origin, normal = plane(motion.grid, k)
    axes = motion.grid.direction[:, :2]
    inner, outer = (
        surface.surfaces["lv_endo"],
        np.vstack([surface.surfaces["rv_endo"], surface.surfaces["epi"]]),
    )
    contours = [(cut(surface.points, part, origin, normal) - origin) @ axes for part in (inner, outer)]
    centre = contours[0].mean(axis=(0, 1))
    angle = 2.0 * np.pi * np.arange(ANGLES) / ANGLES
    directions = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    lengths = [ray_crossings(contour, centre, directions).min(axis=1) for contour in contours]
    ends = [origin + (centre + length[:, None] * directions) @ axes.T for length in lengths]
    first, last = (
        _follow(end, surface.points, part, positions) for end, part in zip(ends, (inner, outer), strict=True)
    )
    carried = motion.carry((1.0 - depth) * ends[0] + depth * ends[1])
    return WallPoints(k, normal, carried, (1.0 - depth) * first + depth * last, directions @ axes.T)


def _follow(places: Floats, points: Floats, triangles: Integers, positions: Floats) -> Floats:
    """Where places (n,3) on a surface are in every frame (p,n,3)."""
    nearest, weights = nearest_on_surface(places, points, triangles)
    return np.einsum("nc,pncd->pnd", weights, positions[:, triangles[nearest]])

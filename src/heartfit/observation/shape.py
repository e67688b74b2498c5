"""The shape of a motion: what the left ventricle does that its volume does not tell.

All of it is taken from material points, so one definition serves a simulated beat and a carried measurement.
Lengths and directions are those of phase 0, end diastole; see :class:`Shape` for each quantity. The rings are the
rims of the left endocardium, mitral and aortic.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh, element_volumes
from heartfit.geometry.motion import Motion
from heartfit.geometry.nearest import nearest_on_surface
from heartfit.geometry.topology import rim_loops
from heartfit.observation.volumes import cavity_volumes

APEX, APICAL, MIDDLE, BASAL = (0.0, 0.08), (0.15, 0.40), (0.40, 0.70), (0.65, 0.90)
"""Levels of the left ventricle: ranges of the longitudinal coordinate."""

SPREAD = (1.0, 50.0, 99.0)
"""Percentiles of the elements' change of volume: 98 % of them lie between the outer two."""


@dataclass(frozen=True, eq=False)
class Shape:
    """Curves (p,) over the phases of a motion, zero in phase 0; times in s.

    cavity: volume of the left ventricle, m^3; shortening: of the distance from the epicardial apex to the rings, 1;
    descent: of the rings towards the apex, m; rise: of the apex towards the base, m; inward: of the free wall's
    epicardium towards the axis at mid-height, mean, m; thickening: of the wall at mid-height, 1; twist: apical less
    basal rotation, rad, positive if counter-clockwise seen from the apex; volume (p, 3): percentiles SPREAD of the
    elements' volumes over those of phase 0.
    """

    times: Floats
    cavity: Floats
    shortening: Floats
    descent: Floats
    rise: Floats
    inward: Floats
    thickening: Floats
    twist: Floats
    volume: Floats


def shape_of(mesh: VentricularMesh, motion: Motion) -> Shape:
    """The shape of the motion of a mesh, whose places in phase 0 decide what is apex, level and wall."""
    start = mesh.with_points(motion.positions[0])
    axes = LeftVentricularAxes.of(start)
    apex = _mean(motion, _level(start, axes, "epi", APEX))
    rings = _mean(motion, np.concatenate(rim_loops(mesh.surfaces["lv_endo"])))
    length = np.linalg.norm(rings - apex, axis=1)
    return Shape(
        times=motion.times,
        cavity=cavity_volumes(mesh, motion)["lv_volume"].values,
        shortening=1.0 - length / length[0],
        descent=(rings[0] - rings) @ axes.axis,
        rise=(apex - apex[0]) @ axes.axis,
        inward=_inward(start, axes, motion),
        thickening=_thickening(start, axes, motion),
        twist=_rotation(start, axes, motion, APICAL) - _rotation(start, axes, motion, BASAL),
        volume=_volume_ratios(mesh, motion),
    )


def _mean(motion: Motion, nodes: Integers) -> Floats:
    """Mean place (p,3) of some nodes."""
    place: Floats = motion.positions[:, nodes].mean(axis=1)
    return place


def _level(
    mesh: VentricularMesh, axes: LeftVentricularAxes, surface: str, between: tuple[float, float]
) -> Integers:
    """The nodes of a surface at a level."""
    nodes = np.unique(mesh.surfaces[surface])
    height = axes.longitudinal(mesh.points[nodes])
    return nodes[(height >= between[0]) & (height <= between[1])]


def _inward(mesh: VentricularMesh, axes: LeftVentricularAxes, motion: Motion) -> Floats:
    """Mean motion (p,) of the epicardium opposite the septum towards the axis."""
    nodes = _level(mesh, axes, "epi", MIDDLE)
    nodes = nodes[np.cos(axes.angle(mesh.points[nodes])) < -0.5]
    radii = [np.linalg.norm(axes.away(positions[nodes]), axis=1).mean() for positions in motion.positions]
    return radii[0] - np.array(radii)


def _thickening(mesh: VentricularMesh, axes: LeftVentricularAxes, motion: Motion) -> Floats:
    """Relative change (p,) of the mean distance from the left endocardium at mid-height to the wall's other side."""
    inner = _level(mesh, axes, "lv_endo", MIDDLE)
    outside = np.vstack([mesh.surfaces["epi"], mesh.surfaces["rv_endo"]])
    depths = []
    for positions in motion.positions:
        triangle, weights = nearest_on_surface(positions[inner], positions, outside)
        foot = np.einsum("qc,qcd->qd", weights, positions[outside[triangle]])
        depths.append(np.linalg.norm(foot - positions[inner], axis=1).mean())
    return np.array(depths) / depths[0] - 1.0


def _rotation(
    mesh: VentricularMesh, axes: LeftVentricularAxes, motion: Motion, between: tuple[float, float]
) -> Floats:
    """Angle (p,) in rad by which the left endocardium of a level turns about its own centre."""
    places = motion.positions[:, _level(mesh, axes, "lv_endo", between)]
    flat = np.stack([places @ axes.septal, places @ axes.anterior], axis=-1)
    flat -= flat.mean(axis=1, keepdims=True)
    plane = flat[..., 0] + 1j * flat[..., 1]
    return -np.angle((plane * plane[0].conj()).sum(axis=1))


def _volume_ratios(mesh: VentricularMesh, motion: Motion) -> Floats:
    start = element_volumes(motion.positions[0], mesh.tets)
    ratios = [element_volumes(positions, mesh.tets) / start for positions in motion.positions]
    return np.percentile(ratios, SPREAD, axis=1).T

"""Volumes of both cavities and shape of the left ventricle over the motion of a mesh.

The shape is taken from material points, so one definition serves a simulated beat and a carried measurement; it
describes the motion of the left ventricle that its volume leaves open. Lengths and directions are those of phase 0, end
diastole; see :class:`Shape` for each quantity. The rings are the rims of the left endocardium, mitral and aortic.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.carry import nearest_on_surface
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import Motion, VentricularMesh, element_volumes
from heartfit.geometry.surface import rim_loops
from heartfit.observation.curve import Curve

APEX_LEVEL, APICAL_LEVEL, MIDDLE_LEVEL, BASAL_LEVEL = (0.0, 0.08), (0.15, 0.40), (0.40, 0.70), (0.65, 0.90)
"""Levels of the left ventricle: ranges of the longitudinal coordinate [1]."""

VOLUME_PERCENTILES = (1.0, 50.0, 99.0)
"""Percentiles of the relative volumes of the elements; 98 % lie between the outer two."""


def cavity_volumes(mesh: VentricularMesh, motion: Motion) -> dict[str, Curve]:
    """Curves "lv_volume" and "rv_volume" [m^3] of the mesh in every phase of the motion."""
    return {
        f"{side}_volume": _volume(Cavity.from_endocardium(mesh, f"{side}_endo"), motion)
        for side in ("lv", "rv")
    }


def _volume(cavity: Cavity, motion: Motion) -> Curve:
    volumes = [cavity.volume(positions) for positions in motion.positions]
    return Curve.of_volume(motion.times, volumes, motion.period)


@dataclass(frozen=True, eq=False)
class Shape:
    """Curves (p,) over the phases of a motion, zero in phase 0; times [s].

    cavity: volume of the left ventricle [m^3]; shortening: of the distance from the epicardial apex to the rings [1];
    descent: of the rings towards the apex [m]; rise: of the apex towards the base [m]; inward: mean motion of the
    epicardium of the free wall towards the axis at mid-height [m]; thickening: of the wall at mid-height [1]; twist:
    apical minus basal rotation [rad], positive if counter-clockwise seen from the apex; volume (p, 3):
    VOLUME_PERCENTILES of the volumes of the elements over those of phase 0 [1].
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


def motion_shape(mesh: VentricularMesh, motion: Motion) -> Shape:
    """Compute the shape of the motion of a mesh; positions in phase 0 define apex, levels and wall."""
    start = mesh.with_points(motion.positions[0])
    axes = LeftVentricularAxes.from_mesh(start)
    apex = _mean_position(motion, _nodes_at_level(start, axes, "epi", APEX_LEVEL))
    rings = _mean_position(motion, np.concatenate(rim_loops(mesh.surfaces["lv_endo"])))
    length = np.linalg.norm(rings - apex, axis=1)
    return Shape(
        times=motion.times,
        cavity=cavity_volumes(mesh, motion)["lv_volume"].values,
        shortening=1.0 - length / length[0],
        descent=(rings[0] - rings) @ axes.axis,
        rise=(apex - apex[0]) @ axes.axis,
        inward=_inward_motion(start, axes, motion),
        thickening=_thickening(start, axes, motion),
        twist=_rotation(start, axes, motion, APICAL_LEVEL) - _rotation(start, axes, motion, BASAL_LEVEL),
        volume=_volume_ratios(mesh, motion),
    )


def _mean_position(motion: Motion, nodes: Integers) -> Floats:
    """Mean position (p, 3) [m] of some nodes."""
    mean: Floats = motion.positions[:, nodes].mean(axis=1)
    return mean


def _nodes_at_level(
    mesh: VentricularMesh, axes: LeftVentricularAxes, surface: str, between: tuple[float, float]
) -> Integers:
    """Return the nodes of a surface at a level."""
    nodes = np.unique(mesh.surfaces[surface])
    height = axes.longitudinal(mesh.points[nodes])
    return nodes[(height >= between[0]) & (height <= between[1])]


def _inward_motion(mesh: VentricularMesh, axes: LeftVentricularAxes, motion: Motion) -> Floats:
    """Mean motion (p,) [m] towards the axis of the epicardium opposite the septum."""
    nodes = _nodes_at_level(mesh, axes, "epi", MIDDLE_LEVEL)
    nodes = nodes[np.cos(axes.angle(mesh.points[nodes])) < -0.5]
    radii = [np.linalg.norm(axes.away(positions[nodes]), axis=1).mean() for positions in motion.positions]
    return radii[0] - np.array(radii)


def _thickening(mesh: VentricularMesh, axes: LeftVentricularAxes, motion: Motion) -> Floats:
    """Relative change (p,) of the mean distance from the left endocardium at mid-height to the outer surfaces."""
    inner = _nodes_at_level(mesh, axes, "lv_endo", MIDDLE_LEVEL)
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
    """Rotation (p,) [rad] of the left endocardium of a level about its centre."""
    places = motion.positions[:, _nodes_at_level(mesh, axes, "lv_endo", between)]
    flat = np.stack([places @ axes.septal, places @ axes.anterior], axis=-1)
    flat -= flat.mean(axis=1, keepdims=True)
    plane = flat[..., 0] + 1j * flat[..., 1]
    return -np.angle((plane * plane[0].conj()).sum(axis=1))


def _volume_ratios(mesh: VentricularMesh, motion: Motion) -> Floats:
    start = element_volumes(motion.positions[0], mesh.tets)
    ratios = [element_volumes(positions, mesh.tets) / start for positions in motion.positions]
    return np.percentile(ratios, VOLUME_PERCENTILES, axis=1).T

"""Where and when the healthy heart starts to depolarise, and the activation times that follow.

References
----------
Durrer D et al. 1970, doi 10.1161/01.CIR.41.6.899: three early sites on the left endocardium, anterior
paraseptal, mid septal and posterior paraseptal; the right ventricle follows near the insertion of its
anterior papillary muscle.
"""

from dataclasses import dataclass, replace

import numpy as np

from heartfit.electrophysiology.eikonal import activation_times
from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.coordinates import LeftVentricularAxes, septal_faces
from heartfit.geometry.mesh import VentricularMesh


@dataclass(frozen=True)
class Site:
    """A place on an endocardium: longitudinal 0 apex .. 1 base, angle in rad from septum to anterior; s."""

    longitudinal: float
    angle: float
    time: float


LEFT_SITES = (
    Site(0.70, np.deg2rad(75.0), 0.0),
    Site(0.55, 0.0, 0.0),
    Site(0.35, np.deg2rad(-75.0), 0.0),
)
RIGHT_SITE = Site(0.45, np.deg2rad(15.0), 0.007)
PURKINJE_HEIGHT = 0.85


def assign_activation(
    mesh: VentricularMesh, speed: float = 0.6, ratio: float = 0.45, fast_speed: float = 3.0
) -> VentricularMesh:
    """The mesh with the activation time T_d of each tet, earliest 0, of a healthy onset.

    speed in m/s along fibres, ratio of the speed across to it, fast_speed in m/s under the endocardium.
    Raises ValueError when the mesh has no fibres.
    """
    if mesh.fibres is None:
        raise ValueError("activation: the mesh has no fibres; prepare it first")
    nodal = activation_times(
        mesh.points,
        mesh.tets,
        mesh.fibres,
        healthy_onset(mesh),
        speed,
        ratio,
        fast_layer=purkinje_layer(mesh),
        fast_speed=fast_speed,
    )
    of_tets = nodal[mesh.tets].mean(axis=1)
    return replace(mesh, activation=of_tets - of_tets.min())


def healthy_onset(mesh: VentricularMesh) -> dict[int, float]:
    """The nodes {node: time in s} where depolarisation starts."""
    axes = LeftVentricularAxes.of(mesh)
    left = np.unique(mesh.surfaces["lv_endo"])
    free = np.setdiff1d(np.unique(mesh.surfaces["rv_endo"]), np.unique(septal_faces(mesh, axes)))
    onset = {_nearest(mesh.points, left, axes, site): site.time for site in LEFT_SITES}
    return onset | {_nearest(mesh.points, free, axes, RIGHT_SITE): RIGHT_SITE.time}


def purkinje_layer(mesh: VentricularMesh) -> Integers:
    """The endocardial triangles (k,3) below the base, where the Purkinje network conducts."""
    faces = np.vstack([mesh.surfaces["lv_endo"], mesh.surfaces["rv_endo"]])
    height = LeftVentricularAxes.of(mesh).longitudinal(mesh.points)[faces].max(axis=1)
    return faces[height < PURKINJE_HEIGHT]


def _nearest(points: Floats, nodes: Integers, axes: LeftVentricularAxes, site: Site) -> int:
    """The node nearest to a site, the angle counted as an arc at the nodes' mean distance from the axis."""
    candidates = points[nodes]
    radius = np.linalg.norm(axes.away(candidates), axis=1).mean()
    arc = radius * np.abs(np.angle(np.exp(1j * (axes.angle(candidates) - site.angle))))
    along = axes.length * (axes.longitudinal(candidates) - site.longitudinal)
    return int(nodes[np.hypot(arc, along).argmin()])

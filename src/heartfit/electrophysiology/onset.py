"""The activation times that follow from where the ventricles start to depolarise."""

from dataclasses import replace

import numpy as np

from heartfit.electrophysiology.conduction import HEALTHY, Conduction, Site
from heartfit.electrophysiology.eikonal import activation_times
from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.coordinates import LeftVentricularAxes, septal_faces
from heartfit.geometry.mesh import VentricularMesh

PURKINJE_HEIGHT = 0.85


def assign_activation(mesh: VentricularMesh, conduction: Conduction = HEALTHY) -> VentricularMesh:
    """The mesh with the activation time T_d of each tet, earliest 0.

    Raises ValueError when the mesh has no fibres.
    """
    of_tets = nodal_times(mesh, conduction)[mesh.tets].mean(axis=1)
    return replace(mesh, activation=of_tets - of_tets.min())


def nodal_times(mesh: VentricularMesh, conduction: Conduction) -> Floats:
    """When each node (n,) depolarises, s; the sites do at their own times. Raises ValueError without fibres."""
    if mesh.fibres is None:
        raise ValueError("activation: the mesh has no fibres; prepare it first")
    left, right = endocardial_layer(mesh, "lv_endo"), endocardial_layer(mesh, "rv_endo")
    return activation_times(
        mesh.points,
        mesh.tets,
        mesh.fibres,
        onset(mesh, conduction.sites),
        conduction.speed,
        conduction.ratio,
        fast_layer=np.vstack([left, right]),
        fast_speed=np.repeat([conduction.left_layer, conduction.right_layer], [len(left), len(right)]),
    )


def onset(mesh: VentricularMesh, sites: tuple[Site, ...]) -> dict[int, float]:
    """The nodes {node: time in s} where depolarisation starts."""
    axes = LeftVentricularAxes.of(mesh)
    septal = np.unique(septal_faces(mesh, axes))
    walls = {
        "left": np.unique(mesh.surfaces["lv_endo"]),
        "septal": septal,
        "free": np.setdiff1d(np.unique(mesh.surfaces["rv_endo"]), septal),
    }
    return {_nearest(mesh.points, walls[site.wall], axes, site): site.time for site in sites}


def endocardial_layer(mesh: VentricularMesh, surface: str) -> Integers:
    """The triangles (k,3) of an endocardium below the base, where the Purkinje network lies."""
    faces = mesh.surfaces[surface]
    height = LeftVentricularAxes.of(mesh).longitudinal(mesh.points)[faces].max(axis=1)
    return faces[height < PURKINJE_HEIGHT]


def _nearest(points: Floats, nodes: Integers, axes: LeftVentricularAxes, site: Site) -> int:
    """The node nearest to a site, the angle counted as an arc at the nodes' mean distance from the axis."""
    candidates = points[nodes]
    radius = np.linalg.norm(axes.away(candidates), axis=1).mean()
    arc = radius * np.abs(np.angle(np.exp(1j * (axes.angle(candidates) - site.angle))))
    along = axes.length * (axes.longitudinal(candidates) - site.longitudinal)
    return int(nodes[np.hypot(arc, along).argmin()])

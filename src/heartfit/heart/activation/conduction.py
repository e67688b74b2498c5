"""Conduction of the ventricles: early sites and speeds, activation times, and a fit to the duration of the QRS complex.

Two conductions are provided: health, and left bundle branch block.

References
----------
Durrer D et al. 1970, doi 10.1161/01.CIR.41.6.899: three early sites on the left endocardium, anterior
paraseptal, mid septal and posterior paraseptal; the right ventricle follows near the insertion of its
anterior papillary muscle.
Auricchio A et al. 2004, doi 10.1161/01.CIR.0000118502.91105.F6, and Strik M et al. 2012, doi
10.1007/s12265-012-9351-1: in left bundle branch block the right ventricle comes first, the wave runs slowly through the
septum, and it ends at the lateral or posterolateral base.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Literal

import numpy as np

from heartfit.core.arrays import Floats, Integers
from heartfit.core.errors import InputError
from heartfit.geometry.coordinates import LeftVentricularAxes, septal_faces
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.activation.eikonal import activation_times


@dataclass(frozen=True)
class Site:
    """Site on an endocardium at which depolarisation starts.

    ``wall``: left ventricle, or septal or free wall of the right one; ``longitudinal``: 0 at the apex to 1 at the base;
    ``angle`` [rad] around the left ventricle, from the middle of the septum towards anterior; ``time`` of onset [s].
    """

    wall: Literal["left", "septal", "free"]
    longitudinal: float
    angle: float
    time: float


@dataclass(frozen=True)
class Conduction:
    """Sites of onset; speeds along the fibres [m/s], across them as a ratio, and in the endocardial layers [m/s]."""

    sites: tuple[Site, ...]
    speed: float = 0.6
    ratio: float = 0.45
    left_layer: float = 3.0
    right_layer: float = 3.0


_RIGHT_PAPILLARY = (0.45, np.deg2rad(15.0))
HEALTHY = Conduction(
    (
        Site("left", 0.70, np.deg2rad(75.0), 0.0),
        Site("left", 0.55, 0.0, 0.0),
        Site("left", 0.35, np.deg2rad(-75.0), 0.0),
        Site("free", *_RIGHT_PAPILLARY, 0.007),
    )
)
"""Both bundles conduct, into Purkinje networks on both sides."""

LBBB = Conduction(
    (Site("septal", 0.35, np.deg2rad(15.0), 0.0), Site("free", *_RIGHT_PAPILLARY, 0.0)),
    ratio=0.35,
    left_layer=0.8,
)
"""Left bundle branch block: only the right bundle conducts; the left endocardium is hardly faster than the wall."""

CONDUCTIONS: Mapping[str, Conduction] = MappingProxyType({"healthy": HEALTHY, "lbbb": LBBB})

PURKINJE_HEIGHT = 0.85
"""Longitudinal coordinate up to which the endocardium carries a Purkinje network."""


def assign_activation(mesh: VentricularMesh, conduction: Conduction = HEALTHY) -> VentricularMesh:
    """Mesh with the activation times T_d (m,) [s] of its tetrahedra, the earliest being 0.

    Raises ValueError if the mesh has no fibres.
    """
    times = nodal_times(mesh, conduction)[mesh.tets].mean(axis=1)
    return replace(mesh, activation=times - times.min())


def nodal_times(mesh: VentricularMesh, conduction: Conduction) -> Floats:
    """Depolarisation times of the nodes (n,) [s]; raises ValueError if the mesh has no fibres."""
    if mesh.fibres is None:
        raise ValueError("activation: expected a mesh with fibres, found none; prepare the mesh first")
    left, right = endocardial_layer(mesh, "lv_endo"), endocardial_layer(mesh, "rv_endo")
    return activation_times(
        mesh.points,
        mesh.tets,
        mesh.fibres,
        onset_times(mesh, conduction.sites),
        conduction.speed,
        conduction.ratio,
        fast_layer=np.vstack([left, right]),
        fast_speed=np.repeat([conduction.left_layer, conduction.right_layer], [len(left), len(right)]),
    )


def onset_times(mesh: VentricularMesh, sites: tuple[Site, ...]) -> dict[int, float]:
    """Times [s] of the nodes at which depolarisation starts, by node."""
    axes = LeftVentricularAxes.from_mesh(mesh)
    septal = np.unique(septal_faces(mesh, axes))
    walls = {
        "left": np.unique(mesh.surfaces["lv_endo"]),
        "septal": septal,
        "free": np.setdiff1d(np.unique(mesh.surfaces["rv_endo"]), septal),
    }
    return {_nearest_node(mesh.points, walls[site.wall], axes, site): site.time for site in sites}


def endocardial_layer(mesh: VentricularMesh, surface: str) -> Integers:
    """Triangles (k, 3) of an endocardium below PURKINJE_HEIGHT."""
    faces = mesh.surfaces[surface]
    height = LeftVentricularAxes.from_mesh(mesh).longitudinal(mesh.points)[faces].max(axis=1)
    return faces[height < PURKINJE_HEIGHT]


def _nearest_node(points: Floats, nodes: Integers, axes: LeftVentricularAxes, site: Site) -> int:
    """Node nearest to a site; the angle is measured as an arc at the mean distance of the nodes from the axis."""
    candidates = points[nodes]
    radius = np.linalg.norm(axes.away(candidates), axis=1).mean()
    arc = radius * np.abs(np.angle(np.exp(1j * (axes.angle(candidates) - site.angle))))
    along = axes.length * (axes.longitudinal(candidates) - site.longitudinal)
    return int(nodes[np.hypot(arc, along).argmin()])


LAYER_SPEEDS, WALL_SPEEDS = (0.4, 1.5), (0.3, 1.0)
"""Admissible speeds [m/s] of the left endocardium without its Purkinje network, and of the wall along its fibres."""

DURATION_TOLERANCE = 5e-4
"""Tolerance of the fitted duration [s]."""

BISECTIONS = 20
"""Largest number of bisections: more than the tolerance needs in the widest range."""

Family = Callable[[float], Conduction]


def fit_conduction(mesh: VentricularMesh, conduction: Conduction, duration: float | None) -> Conduction:
    """Conduction that activates the whole of ``mesh`` within the measured ``duration`` [s], to DURATION_TOLERANCE.

    The speed of the left endocardial layer is bisected within LAYER_SPEEDS. Where no such speed yields the duration,
    the nearest is kept and the speed of the wall is bisected within WALL_SPEEDS. Without a duration the conduction is
    returned unchanged. Raises InputError for a duration that neither reaches.
    """
    if duration is None:
        return conduction
    slowest, fastest = (replace(conduction, left_layer=speed) for speed in LAYER_SPEEDS)
    shortest, longest = total_duration(mesh, fastest), total_duration(mesh, slowest)
    if shortest <= duration <= longest:
        return _bisect_speed(
            mesh, lambda speed: replace(conduction, left_layer=speed), LAYER_SPEEDS, duration
        )
    nearest = slowest if duration > longest else fastest
    _require_within_reach(
        mesh, replace(slowest, speed=WALL_SPEEDS[0]), replace(fastest, speed=WALL_SPEEDS[1]), duration
    )
    return _bisect_speed(mesh, lambda speed: replace(nearest, speed=speed), WALL_SPEEDS, duration)


def total_duration(mesh: VentricularMesh, conduction: Conduction) -> float:
    """Time from the earliest to the latest activation of a tetrahedron [s]."""
    times = assign_activation(mesh, conduction).activation
    assert times is not None
    return float(times.max())


def _bisect_speed(
    mesh: VentricularMesh, family: Family, speeds: tuple[float, float], duration: float
) -> Conduction:
    """Member of the family with the total ``duration`` [s], which falls as the speed rises."""
    slow, fast = speeds
    for _ in range(BISECTIONS):
        middle = (slow * fast) ** 0.5
        excess = total_duration(mesh, family(middle)) - duration
        if abs(excess) < DURATION_TOLERANCE:
            break
        slow, fast = (middle, fast) if excess > 0.0 else (slow, middle)
    return family(middle)


def _require_within_reach(mesh: VentricularMesh, slow: Conduction, fast: Conduction, duration: float) -> None:
    shortest, longest = total_duration(mesh, fast), total_duration(mesh, slow)
    if not shortest <= duration <= longest:
        raise InputError(
            f"activation: QRS of {1e3 * duration:.0f} ms; expected {1e3 * shortest:.0f} to {1e3 * longest:.0f} ms, "
            "the range of this heart; check the duration and its unit"
        )

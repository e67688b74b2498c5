r"""Strain of the left ventricle's wall, segment by segment, of a mesh that is carried through a beat.

With X in phase 0 and x later, :math:`x = \sum_a x_a N_a(X)` in each tetrahedron, and a unit vector n of phase 0,

.. math:: F n = \sum_a x_a (\nabla N_a \cdot n), \qquad E_{nn} = \tfrac12 (|F n|^2 - 1)

is the Green-Lagrange strain along n. n is circumferential, longitudinal and radial in the cylinder about the long
axis, as short-axis images have it. Segment 17, the apical cap, lies on the axis, where these directions mean nothing:
it is left out.
"""

from collections.abc import Sequence

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.bullseye import APEX
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.mechanics.kinematics import shape_gradients

DIRECTIONS = ("circumferential", "longitudinal", "radial")
SEGMENTS = np.arange(1, APEX)
"""AHA 1 to 16."""


def segment_strain(mesh: VentricularMesh, motion: Motion) -> Floats:
    """Mean strain (p, 3, 16) of every phase along DIRECTIONS in SEGMENTS, weighted by the tetrahedra's volumes.

    Phase 0 of the motion is the reference. Raises InputError for a mesh that lacks one of the segments.
    """
    return regional_strain(mesh, motion, [(int(segment),) for segment in SEGMENTS])


def regional_strain(mesh: VentricularMesh, motion: Motion, regions: Sequence[Sequence[int]]) -> Floats:
    """The same (p, 3, r) in regions, each of them some AHA segments."""
    start = mesh.with_points(motion.positions[0])
    gradients, volumes = shape_gradients(start.points, start.tets)
    weights = _shares(_segments_of(mesh, np.concatenate(regions)), regions, volumes)
    along = np.einsum("mad,mnd->mna", gradients, cylinder_directions(start))
    moved = (np.einsum("mna,mad->mnd", along, positions[mesh.tets]) for positions in motion.positions)
    return np.array([weights @ (0.5 * ((stretch**2).sum(axis=-1) - 1.0)) for stretch in moved]).swapaxes(1, 2)


def cylinder_directions(mesh: VentricularMesh) -> Floats:
    """Unit vectors (m, 3, 3) at the centre of each tetrahedron, in the order of DIRECTIONS."""
    axes = LeftVentricularAxes.of(mesh)
    away = axes.away(mesh.points[mesh.tets].mean(axis=1))
    radial = away / np.linalg.norm(away, axis=1, keepdims=True)
    return np.stack(
        [np.cross(axes.axis, radial), np.broadcast_to(axes.axis, radial.shape), radial],
        axis=1,
    )


def _segments_of(mesh: VentricularMesh, needed: Integers) -> Integers:
    if mesh.segments is None:
        raise InputError("strain: the mesh has no AHA segments; expected a prepared mesh: build it again")
    missing = np.setdiff1d(needed, mesh.segments)
    if len(missing):
        raise InputError(
            f"strain: no tetrahedron lies in segment {', '.join(map(str, missing))}; "
            f"expected one in each of {', '.join(map(str, needed))}: take a finer mesh"
        )
    return mesh.segments


def _shares(segments: Integers, regions: Sequence[Sequence[int]], volumes: Floats) -> Floats:
    """Weights (r, m) of the tetrahedra in the mean over each region."""
    inside = np.array([np.isin(segments, region) for region in regions]) * volumes
    shares: Floats = inside / inside.sum(axis=1, keepdims=True)
    return shares

"""Rule-based fibres, with a helix angle that runs linearly across the wall from endocardium to epicardium.

Equations
---------
With harmonic fields phi_lv, phi_rv, phi_epi that are 1 on their surface and 0 on the two others, in each wall
    e_l = longitudinal (grad psi, apex to base),  e_t = transmural,  e_c = e_l x e_t = circumferential,
    w = phi_epi,  d = phi_rv / (phi_lv + phi_rv),  alpha = endo (1 - w) + epi w,
    f_lv : e_t = -grad phi_lv, angle (1 - 2 d) alpha        f_rv : e_t = grad phi_rv, angle (1 - 2 d) alpha
    f_epi: e_t = grad phi_epi, angle alpha                  f(angle) = cos(angle) e_c + sin(angle) e_l
    f = principal direction of (1 - w) [(1 - d) f_lv f_lv' + d f_rv f_rv'] + w f_epi f_epi'.

Bayer et al. take the angle endo instead of alpha in the endocardial frames: after blending, the mid-wall is
then still at +30 degrees. Here the mid-wall is circumferential. Blending the tensors f f' needs no sign of f
and no quaternions.

Within one tetrahedron of a coarse mesh the helix turns by 80 degrees and more, and the fibre at its centroid is
never longitudinal: a wall of one or two tetrahedra would have no longitudinal fibres at all. So a tetrahedron
also has the mean of f f' over its volume, its orientation.

References
----------
Bayer JD et al. 2012, doi 10.1007/s10439-012-0593-5.
"""

from dataclasses import dataclass, replace

import numpy as np
from skfem.quadrature import get_quadrature
from skfem.refdom import RefTet

from heartfit.core.arrays import COLUMN, ROW, Floats
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.harmonic import (
    apicobasal_gradient,
    harmonic_between,
    normalise_rows,
    replace_parallel,
    wall_gradient,
)
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.segments import aha_segments

CENTROID = np.full(4, 0.25)
"""Barycentric coordinates of the centroid of a tetrahedron."""

DEGREE = 7
"""Degree of the polynomials that the quadrature over a tetrahedron integrates exactly; 24 points."""


@dataclass(frozen=True, eq=False)
class FibreRule:
    """The fibre rule on a mesh.

    phi (3,n): phi_lv, phi_rv, phi_epi at the nodes; across: their three gradients (m,3); along: grad psi (m,3) for each
    of them; endo, epi: helix angles [rad], positive if right-handed.
    """

    mesh: VentricularMesh
    phi: Floats
    across: tuple[Floats, ...]
    along: tuple[Floats, ...]
    endo: float
    epi: float

    @classmethod
    def from_mesh(
        cls, mesh: VentricularMesh, endo: float = np.deg2rad(80.0), epi: float = -np.deg2rad(80.0)
    ) -> "FibreRule":
        """Return the rule with helix angles `endo` and `epi` [rad] on a mesh."""
        phi = np.array([_surface_field(mesh, name) for name in ("lv_endo", "rv_endo", "epi")])
        across = tuple(wall_gradient(mesh, field) for field in phi)
        upwards = apicobasal_gradient(mesh)
        along = tuple(replace_parallel(mesh, upwards, transmural) for transmural in across)
        return cls(mesh, phi, across, along, endo, epi)

    def fibres(self) -> Floats:
        """Unit fibre directions (m,3) at the centroids."""
        return self._at(CENTROID)

    def orientation(self) -> Floats:
        """Mean (m,6) of f f' over each tetrahedron, of trace 1; six-vectors as in heartfit.core.arrays."""
        points, weights = get_quadrature(RefTet, DEGREE)
        corners = np.vstack([1.0 - points.sum(axis=0), points]).T
        fibres = (self._at(corner) for corner in corners)
        mean: Floats = sum(
            w * f[:, ROW] * f[:, COLUMN] for w, f in zip(weights / weights.sum(), fibres, strict=True)
        )
        return mean

    def _at(self, corner: Floats) -> Floats:
        """Fibres (m,3) at the barycentric coordinates `corner` (4,) of each tetrahedron."""
        lv, rv, w = self.phi[:, self.mesh.tets] @ corner
        d = rv / np.maximum(lv + rv, np.finfo(float).eps)
        alpha = self.endo * (1.0 - w) + self.epi * w
        across_lv, across_rv, across_epi = self.across
        along_lv, along_rv, along_epi = self.along
        parts = [
            ((1.0 - w) * (1.0 - d), _fibre(along_lv, -across_lv, (1.0 - 2.0 * d) * alpha)),
            ((1.0 - w) * d, _fibre(along_rv, across_rv, (1.0 - 2.0 * d) * alpha)),
            (w, _fibre(along_epi, across_epi, alpha)),
        ]
        return _principal(sum(weight[:, None, None] * f[:, :, None] * f[:, None, :] for weight, f in parts))


def _surface_field(mesh: VentricularMesh, name: str) -> Floats:
    """Return the harmonic field (n,) that is 1 on the named surface and 0 on the two others."""
    others = [mesh.surfaces[other] for other in ("lv_endo", "rv_endo", "epi") if other != name]
    return harmonic_between(
        mesh.points, mesh.tets, one=np.unique(mesh.surfaces[name]), zero=np.unique(np.vstack(others))
    )


def _fibre(along: Floats, across: Floats, angle: Floats) -> Floats:
    """Fibres (m,3) at the angle (m,) [rad] from circumferential to longitudinal in the plane normal to `across`."""
    e_t = normalise_rows(across)
    e_l = normalise_rows(along - (along * e_t).sum(axis=1, keepdims=True) * e_t)
    return np.cos(angle)[:, None] * np.cross(e_l, e_t) + np.sin(angle)[:, None] * e_l


def _principal(tensors: Floats) -> Floats:
    """Principal directions (m,3) of tensors (m,3,3), of the sign that makes the largest component positive."""
    axis: Floats = np.linalg.eigh(tensors)[1][:, :, 2]
    largest = np.take_along_axis(axis, np.abs(axis).argmax(axis=1)[:, None], axis=1)
    return axis * np.sign(largest)


def prepare(mesh: VentricularMesh) -> VentricularMesh:
    """Return the mesh with rule-based fibres, AHA segments and the longitudinal coordinate."""
    rule = FibreRule.from_mesh(mesh)
    return replace(
        mesh,
        fibres=rule.fibres(),
        orientation=rule.orientation(),
        segments=aha_segments(mesh),
        longitudinal=LeftVentricularAxes.from_mesh(mesh).longitudinal(mesh.points),
    )

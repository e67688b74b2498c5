"""One mesh for all virtual hearts: made once of an average wall, and moved to the wall of each.

The mesher takes seconds, moving a third of a second.
"""

import warnings
from dataclasses import dataclass

import numpy as np

from heartfit.cohort.draw_shape import AVERAGE
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.geometry.quality import defect_of
from heartfit.geometry.surface import LabelledSurface
from heartfit.registration.carry import boundary_surface, carry_nodes

TEMPLATE_ANGLE = np.deg2rad(10.0)
"""Smallest dihedral angle of a template, rad: some of it is lost on the way to another shape."""


@dataclass(frozen=True, eq=False)
class Template:
    """A mesh of the wall within AVERAGE's surface; wished edge length and tolerance of its mesher, m."""

    mesh: VentricularMesh
    edge_length: float
    tolerance: float

    @classmethod
    def build(cls, edge_length: float, tolerance: float) -> "Template":
        """A new template; raises MeshingError as the mesher does."""
        from heartfit.geometry.mesher import fill_wall  # who only moves a template needs no mesher

        mesh = fill_wall(AVERAGE.surface(), edge_length, tolerance, TEMPLATE_ANGLE)
        return cls(mesh, edge_length, tolerance)

    def shaped(self, shape: ParametricVentricles) -> VentricularMesh:
        """The mesh moved into the wall of this shape."""
        return self._moved(AVERAGE.surface(), shape.surface())

    def refilling(self, acquired: VentricularMesh, other: VentricularMesh) -> VentricularMesh:
        """The mesh moved into the wall of ``acquired``, which is the ``other`` template's mesh moved there.

        Its boundary follows that of the other mesh, so both have one wall; inside nothing is shared.
        """
        here, there = (boundary_surface(mesh, mesh.points) for mesh in (other, acquired))
        return self._moved(here, there)

    def _moved(self, here: LabelledSurface, there: LabelledSurface) -> VentricularMesh:
        """The mesh moved from one surface to another, or one made anew where moving spoils it."""
        defect = "the surfaces are numbered differently"
        if np.array_equal(here.triangles, there.triangles):
            moved = self.mesh.with_points(carry_nodes(self.mesh, here, there.points[None])[0])
            defect = defect_of(moved, there)
            if not defect:
                return moved
        return self._made_anew(there, defect)

    def _made_anew(self, surface: LabelledSurface, defect: str) -> VentricularMesh:
        from heartfit.geometry.mesher import fill_wall

        warnings.warn(f"template does not fit: {defect}; the wall is meshed anew", stacklevel=2)
        return fill_wall(surface, self.edge_length, self.tolerance)

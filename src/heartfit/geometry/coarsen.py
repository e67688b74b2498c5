"""A coarser mesh of the same wall, and the motion of its nodes."""

import numpy as np

from heartfit.geometry.carry import boundary_surface, carry_mesh
from heartfit.geometry.fibres import prepare
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.geometry.mesher import fill_wall


def coarsen(
    mesh: VentricularMesh, motion: Motion, edge_length: float, tolerance: float
) -> tuple[VentricularMesh, Motion]:
    """Return another mesh of the wall, with fibres and segments, and its motion.

    edge_length, tolerance: of the mesher [m]. The boundary follows the boundary of ``mesh`` in every phase; inside, the
    displacement is harmonic. Raises MeshingError as the mesher does.
    """
    surface = boundary_surface(mesh, mesh.points)
    coarse = prepare(fill_wall(surface, edge_length, tolerance))
    phases = [boundary_surface(mesh, positions).points for positions in motion.positions]
    return coarse, carry_mesh(coarse, surface, np.array(phases), motion.times, motion.period)

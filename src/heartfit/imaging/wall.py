"""Which voxels belong to the wall that a mesh describes."""

import numpy as np
from numpy.typing import NDArray

from heartfit.geometry.mesh import VentricularMesh
from heartfit.imaging.grid import Grid
from heartfit.imaging.raster import paint_wall


def wall_voxels(grid: Grid, mesh: VentricularMesh) -> NDArray[np.bool_]:
    """Whether the centre of each voxel (k,j,i) lies in a tetrahedron of the mesh."""
    places = grid.index(mesh.points)
    painted = np.zeros(grid.shape)
    paint_wall(painted, places, mesh.tets, places, np.ones((1, 1, 1)), np.zeros((grid.size[2], 2)))
    return painted > 0.0

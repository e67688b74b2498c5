"""Undoes the folds of a mesh that follows a displacement smooth enough for images, but not for a tetrahedron.

Where a strong apex closes, the images move by more than a tetrahedron's height within its width. A stiffer displacement
would hold back the whole wall for it. So only the nodes of such tetrahedra are moved otherwise: each by the mean over
the tetrahedra about it, again until all of them have some volume left. Where that takes many nodes it is not the mesh
that is at fault but the displacement, which is then left as it is.
"""

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh, element_volumes

LEAST = 0.05
"""Volume of a tetrahedron, over that at end diastole, below which its nodes are moved otherwise."""

MOST = 0.05
"""Share of the nodes that may be moved otherwise."""
TIMES = 50


def unfolded(mesh: VentricularMesh, positions: Floats) -> Floats:
    """Places (n,3) m of the nodes with no tetrahedron inside out, or those given where that takes too many nodes."""
    displacement, before = positions - mesh.points, mesh.element_volumes()
    otherwise = np.zeros(len(positions), dtype=bool)
    for _ in range(TIMES):
        flat = element_volumes(mesh.points + displacement, mesh.tets) < LEAST * before
        if not flat.any():
            break
        nodes = np.unique(mesh.tets[flat])
        otherwise[nodes] = True
        if otherwise.mean() > MOST:
            return positions
        displacement[nodes] = _mean_about(mesh, displacement)[nodes]
    return np.where(otherwise[:, None], mesh.points + displacement, positions)


def _mean_about(mesh: VentricularMesh, values: Floats) -> Floats:
    """The mean (n,3) over the tetrahedra that meet in each node of their nodes' values (n,3)."""
    total, corners = np.zeros_like(values), mesh.tets
    np.add.at(total, corners, values[corners].mean(axis=1)[:, None])
    mean: Floats = total / np.bincount(corners.ravel(), minlength=len(values))[:, None]
    return mean

r"""What holds the heart in the chest: springs at the valve rings, the pericardium, the fibrous annulus.

Robin conditions on the reference surfaces, lumped to the nodes:

.. math:: t = -k_b u - c_b \dot u \text{ on the rings}, \qquad t = -k_p (\zeta) (u \cdot N) N \text{ on the epicardium.}

The pericardium slides; it is stiffer towards the apex, where it is tied to the diaphragm.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.parameter import parameter, require_admissible


@dataclass(frozen=True)
class Support:
    """Stiffness of the surroundings."""

    k_b: float = parameter(1e4, unit="Pa/m", symbol="k_b", meaning="springs at the valve rings")
    c_b: float = parameter(5e3, unit="Pa.s/m", symbol="c_b", meaning="damping at the valve rings")
    k_p: float = parameter(1e5, unit="Pa/m", symbol="k_p", meaning="normal stiffness of the pericardium")
    apical: float = parameter(
        50.0, unit="1", symbol="a", meaning="pericardial stiffness at the apex over k_p"
    )
    reach: float = parameter(
        0.4, unit="1", symbol=r"\zeta_a", meaning="longitudinal reach of the apical stiffening"
    )
    annulus: float = parameter(
        50.0, unit="1", symbol="r", meaning="passive stiffness of the valve annuli over the wall's"
    )
    annulus_core: float = parameter(
        3e-3, unit="m", symbol="d_0", meaning="width of the annuli at full stiffness"
    )
    annulus_width: float = parameter(9e-3, unit="m", symbol="d_1", meaning="distance at which the annuli end")

    def __post_init__(self) -> None:
        require_admissible(self)

    def stiffness(self, mesh: VentricularMesh) -> Floats:
        """Nodal spring matrices (n, 3, 3), N/m."""
        epi = mesh.surfaces["epi"]
        normals = _area_normals(mesh.points, epi)
        areas = np.linalg.norm(normals, axis=1)
        unit = normals / areas[:, None]
        moduli = areas * self._pericardium(mesh, epi)
        dyads = moduli[:, None, None] * unit[:, :, None] * unit[:, None, :]
        return _lump(dyads, epi, len(mesh.points)) + self.k_b * self._rings(mesh)

    def damping(self, mesh: VentricularMesh) -> Floats:
        """Nodal damper matrices (n, 3, 3), N.s/m."""
        return self.c_b * self._rings(mesh)

    def passive_scale(self, mesh: VentricularMesh) -> Floats:
        """Factor (m,) on the passive moduli: the annuli are collagen, not muscle, but carry muscle's tension."""
        rings = mesh.points[np.unique(mesh.surfaces["base"])]
        distance = _distances(mesh.points[mesh.tets].mean(axis=1), rings)
        ramp = np.clip((self.annulus_width - distance) / (self.annulus_width - self.annulus_core), 0.0, 1.0)
        scale: Floats = self.annulus**ramp
        return scale

    def _pericardium(self, mesh: VentricularMesh, triangles: np.ndarray) -> Floats:
        zeta = np.asarray(mesh.longitudinal)[triangles].mean(axis=1)
        ramp = np.clip((self.reach - zeta) / self.reach, 0.0, 1.0)
        return self.k_p * (1.0 + (self.apical - 1.0) * ramp)

    @staticmethod
    def _rings(mesh: VentricularMesh) -> Floats:
        base = mesh.surfaces["base"]
        areas = np.linalg.norm(_area_normals(mesh.points, base), axis=1)
        return _lump(areas[:, None, None] * np.eye(3), base, len(mesh.points))


def _area_normals(points: Floats, triangles: np.ndarray) -> Floats:
    """Normals (k, 3) of triangles, as long as their area."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    normals: Floats = 0.5 * np.cross(b - a, c - a)
    return normals


def _lump(blocks: Floats, triangles: np.ndarray, nodes: int) -> Floats:
    """Spread each triangle's block (k, 3, 3) evenly over its corners."""
    result = np.zeros((nodes, 3, 3))
    for corner in range(3):
        np.add.at(result, triangles[:, corner], blocks / 3.0)
    return result


def _distances(points: Floats, others: Floats) -> Floats:
    """How far (n,) each point is from the nearest of the others: sooner done than a tree is imported."""
    squares = (points**2).sum(axis=1)[:, None] + (others**2).sum(axis=1) - 2.0 * points @ others.T
    return np.sqrt(np.maximum(squares.min(axis=1), 0.0))

"""The ventricles as tetrahedra with named surfaces and the fields that the physics needs."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.surface import SURFACES as SURFACES


@dataclass(frozen=True, eq=False)
class VentricularMesh:
    """Tetrahedra of the wall of both ventricles.

    points (n,3) m; tets (m,4) positively oriented; surfaces: name -> boundary triangles (k,3), normals out of
    the wall; fibres (m,3) unit vectors; segments (m,) AHA 1..17, 0 = right ventricular free wall;
    activation (m,) s, time T_d at which each tet depolarises, earliest = 0;
    longitudinal (n,) 0 apex .. 1 base; orientation (m,6) mean of f f' over the tet, where it is not that of one fibre.
    Raises ValueError when a field's shape does not match the points or tets.
    """

    points: Floats
    tets: Integers
    surfaces: Mapping[str, Integers]
    fibres: Floats | None = None
    segments: Integers | None = None
    activation: Floats | None = None
    longitudinal: Floats | None = None
    orientation: Floats | None = None

    def __post_init__(self) -> None:
        n, m = len(self.points), len(self.tets)
        expected = {"points": (n, 3), "tets": (m, 4), "fibres": (m, 3), "segments": (m,)}
        expected |= {"activation": (m,), "longitudinal": (n,), "orientation": (m, 6)}
        for name, shape in expected.items():
            field = getattr(self, name)
            if field is not None and field.shape != shape:
                raise ValueError(f"mesh: {name} has shape {field.shape}, expected {shape}")
        missing = sorted(set(SURFACES) - set(self.surfaces))
        if missing:
            raise ValueError(f"mesh: surfaces {missing} are missing, expected {', '.join(SURFACES)}")

    def with_points(self, points: Floats) -> "VentricularMesh":
        """The same mesh with its nodes at other places."""
        return replace(self, points=points)

    def element_volumes(self) -> Floats:
        """Signed volumes (m,) in m^3 of the tetrahedra."""
        return element_volumes(self.points, self.tets)

    def wall_volume(self) -> float:
        """Volume in m^3 of the wall."""
        return float(self.element_volumes().sum())


def element_volumes(points: Floats, tets: Integers) -> Floats:
    """Signed volumes (m,) = det[b - a, c - a, d - a] / 6, positive for positively oriented tetrahedra."""
    a, b, c, d = points[tets.T]
    return np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6.0

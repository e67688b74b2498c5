"""Tetrahedral mesh of the ventricles, its quality, and its motion through the beat."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from heartfit.core.arrays import Floats, Integers
from heartfit.core.errors import InputError
from heartfit.geometry.surface import FACES_OF_TET, LabelledSurface, euler_characteristic, rim_loops
from heartfit.geometry.surface import SURFACES as SURFACES


@dataclass(frozen=True, eq=False)
class VentricularMesh:
    """Tetrahedra of the wall of both ventricles.

    points (n,3) [m]; tets (m,4) positively oriented; surfaces: name -> boundary triangles (k,3), normals out of
    the wall; fibres (m,3) unit vectors; segments (m,) AHA 1..17, 0 = right ventricular free wall;
    activation (m,) [s]: time T_d of depolarisation of each tet, earliest = 0;
    longitudinal (n,) 0 apex .. 1 base; orientation (m,6) mean of f f' over the tet, unless it is that of one fibre.
    Raises ValueError when a field's shape does not match the points or tets, or a surface is missing.
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
        """Return the same mesh with its nodes at other positions (n,3) [m]."""
        return replace(self, points=points)

    def element_volumes(self) -> Floats:
        """Signed volumes (m,) [m^3] of the tetrahedra."""
        return element_volumes(self.points, self.tets)

    def wall_volume(self) -> float:
        """Volume [m^3] of the wall."""
        return float(self.element_volumes().sum())


def element_volumes(points: Floats, tets: Integers) -> Floats:
    """Signed volumes (m,) [m^3], det[b - a, c - a, d - a] / 6, positive for positively oriented tetrahedra."""
    a, b, c, d = points[tets.T]
    return np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6.0


SMALLEST_ANGLE = np.deg2rad(8.0)
"""Dihedral angle [rad] below which a mesh is refused."""

LARGEST_VOLUME_ERROR = 0.02
"""Relative error of the wall volume above which a mesh is refused."""

PAIRS_OF_FACES = [(i, j) for i in range(4) for j in range(i)]


def smallest_dihedral_angles(points: Floats, tets: Integers) -> Floats:
    """Smallest dihedral angle (m,) [rad] of each tetrahedron; 70.5 degrees at best, 0 for a sliver."""
    a, b, c = np.moveaxis(points[tets[:, FACES_OF_TET]], 2, 0)
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), np.finfo(float).tiny)
    cosines = [-(normals[:, i] * normals[:, j]).sum(axis=1) for i, j in PAIRS_OF_FACES]
    return np.arccos(np.clip(np.max(cosines, axis=0), -1.0, 1.0))


def find_defect(
    mesh: VentricularMesh, surface: LabelledSurface, smallest_angle: float = SMALLEST_ANGLE
) -> str:
    """Return the defect of a mesh that shall fill this surface, or an empty text; smallest_angle: dihedral [rad]."""
    error = mesh.wall_volume() / surface.volume() - 1.0
    if abs(error) > LARGEST_VOLUME_ERROR:
        return f"wall volume off by {100 * error:+.1f} %"
    angle = smallest_dihedral_angles(mesh.points, mesh.tets).min()
    if angle < smallest_angle:
        return f"smallest dihedral angle {np.rad2deg(angle):.1f} degrees"
    boundary = np.vstack(list(mesh.surfaces.values()))
    actual, expected = euler_characteristic(boundary), euler_characteristic(surface.triangles)
    if actual != expected:
        return (
            f"hole in a wall thinner than the tolerance (Euler characteristic {actual} instead of {expected})"
        )
    for name in ("lv_endo", "rv_endo"):
        actual, expected = len(rim_loops(mesh.surfaces[name])), len(rim_loops(surface.surfaces[name]))
        if actual != expected:
            return f"{name} has {actual} openings instead of {expected}"
    return ""


FEWEST_PHASES = 8


@dataclass(frozen=True, eq=False)
class Motion:
    """The same mesh in every phase of one beat; phase 0 is end diastole, at the trigger of the ECG.

    times (p,) [s], within one period; period [s]; positions (p,n,3) [m].
    Raises InputError for fewer than 8 phases, times that do not increase or leave the period, and NaN.
    """

    times: Floats
    period: float
    positions: Floats

    def __post_init__(self) -> None:
        require_phases(len(self.times), "motion")
        if self.positions.shape != (len(self.times), self.positions.shape[1], 3):
            raise InputError(
                f"motion: positions {self.positions.shape}, expected ({len(self.times)}, nodes, 3)"
            )
        if not (np.isfinite(self.times).all() and np.isfinite(self.positions).all()):
            raise InputError("motion: holds NaN or infinite times or positions; expected finite numbers")
        if not (np.diff(self.times) > 0.0).all():
            late = int(np.argmax(np.diff(self.times) <= 0.0)) + 1
            raise InputError(
                f"motion: phase {late} is at {self.times[late]:g} s; expected later than phase {late - 1}"
            )
        if self.times[0] < 0.0 or self.times[-1] >= self.period:
            raise InputError(
                f"motion: times run from {self.times[0]:g} to {self.times[-1]:g} s; "
                f"expected within [0, {self.period:g}) s"
            )

    def at(self, time: float) -> Floats:
        """Positions (n,3) [m] at any time [s], periodic and linear between the phases."""
        after = int(np.searchsorted(self.times, time % self.period, side="right"))
        before, span = after - 1, np.append(self.times, self.times[0] + self.period)
        start = span[before] if after else self.times[-1] - self.period
        share = (time % self.period - start) / (span[after] - start)
        later = self.positions[after % len(self.times)]
        positions: Floats = (1.0 - share) * self.positions[before] + share * later
        return positions

    def resample(self, times: Floats) -> "Motion":
        """Return the motion at other times (q,) [s]."""
        return Motion(times, self.period, np.array([self.at(time) for time in times]))


def require_phases(count: int, where: str) -> None:
    """Raise InputError for fewer phases than filling and ejection need."""
    if count < FEWEST_PHASES:
        raise InputError(
            f"{where}: {count} phases; expected at least {FEWEST_PHASES}; measure the whole beat"
        )

"""Parametric ventricles: a truncated ellipsoid with a crescent-shaped pocket, from a few clinical numbers.

Each sheet of the wall is at a distance s from the left endocardium along its outward normal n, x = e + s n, with the
eccentric angle eta of its ellipsoid (0 base, pi/2 apex) and the azimuth phi (0 at the middle of the septum):

    e  : ellipsoid of semi-axes (a, c)                                               left endocardium, s = 0
    s2 = w                                                          left epicardium and septum's right side
    s3 = w + B (1 - q^2),   q^2 = (phi / phi0)^2 + (eta / eta0)^2   right free wall, inside q < 1
    s4 = w + smooth maximum of 0 and (s3 - w + t)                   epicardium of both ventricles

a follows from the left cavity volume, B from the right one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from heartfit.core.arrays import Floats, Integers, Names
from heartfit.core.errors import InputError
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.surface import LabelledSurface, enclosed_volume, orient

NANOMETRE = 1e-9
"""Distance [m] below which points coincide."""


@dataclass(frozen=True, eq=False)
class Seams:
    """Indices (n,) of the grid points that are nodes, triangles (k,3) between these, and the triangles' names (k,).

    They are valid for all grids that meet at the same points, whatever their shape.
    """

    nodes: Integers
    triangles: Integers
    labels: Names

    @classmethod
    def from_grids(cls, names: Sequence[str], grids: Sequence[Floats]) -> "Seams":
        """Return the seams of grids (i,j,3) [m] with these names; points within a nanometre are one node."""
        points = _stack_points(grids)
        rounded = np.round(points / NANOMETRE)
        _, nodes, merged = np.unique(rounded, axis=0, return_index=True, return_inverse=True)
        start = np.cumsum([0] + [grid.shape[0] * grid.shape[1] for grid in grids])
        triangles = [_grid_triangles(*grid.shape[:2]) + s for grid, s in zip(grids, start[:-1], strict=True)]
        labels = np.repeat(names, [len(part) for part in triangles])
        faces = merged.reshape(-1)[np.concatenate(triangles)]
        whole = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
        oriented = orient(faces[whole].astype(np.int64))
        outwards = enclosed_volume(points[nodes], oriented) > 0.0
        return cls(nodes, oriented if outwards else oriented[:, ::-1], labels[whole])

    def points(self, grids: Sequence[Floats]) -> Floats:
        """Return the nodes' positions (n,3) [m] on these grids."""
        return _stack_points(grids)[self.nodes]

    def surface(self, grids: Sequence[Floats]) -> LabelledSurface:
        """Return the closed surface of these grids."""
        return LabelledSurface(self.points(grids), self.triangles, self.labels)


def _stack_points(grids: Sequence[Floats]) -> Floats:
    return np.concatenate([grid.reshape(-1, 3) for grid in grids])


def _grid_triangles(rows: int, columns: int) -> Integers:
    node = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]
    return np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])


PATCH_AZIMUTH, PATCH_DEPTH = np.deg2rad(78.0), np.deg2rad(65.0)
"""Half-width phi0 and depth eta0 [rad] of the pocket of the right cavity."""

ROUNDING = 3e-3
"""Width s [m] of the smooth maximum."""

HALF_PATCH, OUTSIDE_PATCH, ROWS = 14, 26, 28
"""Numbers of grid intervals on half the patch and around the rest, and of rows from base to apex."""

NAMES = ("lv_endo", "epi", "rv_endo", "rv_endo", "base", "base")
MILLILITRE = 1e-6


@dataclass(frozen=True)
class ParametricVentricles:
    """Both ventricles at end diastole.

    edv, rv_edv: cavity volumes [m^3]; wall_thickness, rv_wall_thickness [m]; sphericity: length of the left
    cavity over its diameter. Raises InputError for a size that no ventricle has.
    """

    edv: float
    wall_thickness: float
    sphericity: float
    rv_edv: float
    rv_wall_thickness: float

    def __post_init__(self) -> None:
        _require_range("edv", self.edv, 20 * MILLILITRE, 600 * MILLILITRE, "m^3")
        _require_range("rv_edv", self.rv_edv, 20 * MILLILITRE, 600 * MILLILITRE, "m^3")
        _require_range("wall_thickness", self.wall_thickness, 3e-3, 30e-3, "m")
        _require_range("rv_wall_thickness", self.rv_wall_thickness, 1e-3, 15e-3, "m")
        _require_range("sphericity", self.sphericity, 0.8, 3.0, "")

    def surface(self) -> LabelledSurface:
        """Return the closed wall surface: base in the plane z = 0, apex towards -z, right ventricle towards +x.

        Nodes and triangles are numbered alike for all shapes. Raises InputError when the right cavity does not fit
        next to the left one.
        """
        from scipy.optimize import brentq

        a, cavity = self._radius(), _cavity("rv_endo")

        def excess(bulge: float) -> float:
            return cavity.volume(_seams().points(self._sheets(a, bulge).grids())) - self.rv_edv

        if excess(4.0 * a) < 0.0:
            raise InputError(
                f"rv_edv {self.rv_edv:g} m^3 does not fit next to edv {self.edv:g} m^3; make it smaller"
            )
        bulge = float(brentq(excess, 1e-3 * a, 4.0 * a, xtol=1e-6 * a))
        return _seams().surface(self._sheets(a, bulge).grids())

    def _radius(self) -> float:
        """Radius a [m] of the left cavity at the base; the volume of the faceted cavity grows with a^3."""
        unit = _seams().points(self._sheets(1.0, 1.0).grids())
        return float(np.cbrt(self.edv / _cavity("lv_endo").volume(unit)))

    def _sheets(self, a: float, bulge: float) -> "_Sheets":
        return _Sheets(a, 2.0 * self.sphericity * a, self.wall_thickness, self.rv_wall_thickness, bulge)


@dataclass(frozen=True)
class _Sheets:
    """Points (..., 3) of the four sheets at the angles (eta, phi)."""

    a: float
    c: float
    wall: float
    right_wall: float
    bulge: float

    def grids(self) -> list[Floats]:
        """Return the parts of the closed surface in the order of NAMES, as grids (i,j,3) of points."""
        turn, patch = _azimuths(), _patch_angles()
        eta, phi = np.meshgrid(np.linspace(0.0, np.pi / 2, ROWS), turn, indexing="ij")
        rim = (np.zeros_like(turn), turn)
        return [
            self.left_endo(eta, phi),
            self.epi(eta, phi),
            self.left_epi(*patch),
            self.right_endo(*patch),
            np.stack([self.left_endo(*rim), self.left_epi(*rim)]),
            np.stack([self.right_endo(*rim), self.epi(*rim)]),
        ]

    def left_endo(self, eta: Floats, phi: Floats) -> Floats:
        across = self.a * np.cos(eta)
        return np.stack([across * np.cos(phi), across * np.sin(phi), -self.c * np.sin(eta)], axis=-1)

    def left_epi(self, eta: Floats, phi: Floats) -> Floats:
        return self._outwards(eta, phi, np.full_like(eta, self.wall))

    def right_endo(self, eta: Floats, phi: Floats) -> Floats:
        return self._outwards(eta, phi, self.wall + np.maximum(self._pocket(eta, phi), 0.0))

    def epi(self, eta: Floats, phi: Floats) -> Floats:
        return self._outwards(
            eta, phi, self.wall + _smooth_positive(self._pocket(eta, phi) + self.right_wall)
        )

    def _pocket(self, eta: Floats, phi: Floats) -> Floats:
        return self.bulge * (1.0 - (phi / PATCH_AZIMUTH) ** 2 - (eta / PATCH_DEPTH) ** 2)

    def _outwards(self, eta: Floats, phi: Floats, distance: Floats) -> Floats:
        endo = self.left_endo(eta, phi)
        normal = endo / np.array([self.a**2, self.a**2, self.c**2])
        return endo + distance[..., None] * normal / np.linalg.norm(normal, axis=-1, keepdims=True)


TEMPLATE_SHEETS = _Sheets(a=0.026, c=0.096, wall=9e-3, right_wall=3.5e-3, bulge=0.03)
"""Sheets [m] of an ordinary heart, from which the seams of all shapes are taken."""


def _smooth_positive(x: Floats) -> Floats:
    """Smooth maximum of x and 0, rounded over ROUNDING: (x + sqrt(x^2 + s^2)) / 2."""
    return 0.5 * (x + np.hypot(x, ROUNDING))


def _azimuths() -> Floats:
    """Closed turn of azimuths whose nodes within the patch coincide with the patch's own at the base."""
    inside = PATCH_AZIMUTH * np.linspace(-1.0, 1.0, 2 * HALF_PATCH + 1)
    outside = np.linspace(PATCH_AZIMUTH, 2.0 * np.pi - PATCH_AZIMUTH, OUTSIDE_PATCH + 1)
    outside = np.where(outside > np.pi, outside - 2.0 * np.pi, outside)
    return np.concatenate([inside, outside[1:]])


def _patch_angles() -> tuple[Floats, Floats]:
    """Polar grid of the half disc q <= 1, eta >= 0, whose diameter lies in the base."""
    q, omega = np.meshgrid(
        np.linspace(0.0, 1.0, HALF_PATCH + 1),
        np.linspace(-np.pi / 2, np.pi / 2, 2 * HALF_PATCH + 1),
        indexing="ij",
    )
    return PATCH_DEPTH * q * np.cos(omega), PATCH_AZIMUTH * q * np.sin(omega)


@cache
def _seams() -> Seams:
    """Seams of the parts, which are the same for all shapes."""
    return Seams.from_grids(NAMES, TEMPLATE_SHEETS.grids())


@cache
def _cavity(name: str) -> Cavity:
    return Cavity.from_endocardium(_seams().surface(TEMPLATE_SHEETS.grids()), name)


def _require_range(name: str, value: float, low: float, high: float, unit: str) -> None:
    if not low <= value <= high:
        raise InputError(
            f"{name} = {value:g} {unit}: expected between {low:g} and {high:g} {unit}; check its unit"
        )

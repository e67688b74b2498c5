"""Ventricles from a handful of clinical numbers: a truncated ellipsoid with a crescent-shaped pocket.

Everything is a distance s from the left endocardium along its outward normal n, x = e + s n, with the
eccentric angle eta of its ellipsoid (0 base, pi/2 apex) and the azimuth phi (0 at the middle of the septum):

    e  : ellipsoid of semi-axes (a, c)                                               left endocardium, s = 0
    s2 = w                                                          left epicardium and septum's right side
    s3 = w + B (1 - q^2),   q^2 = (phi / phi0)^2 + (eta / eta0)^2   right free wall, inside q < 1
    s4 = w + smooth maximum of 0 and (s3 - w + t)                   epicardium of both ventricles

a follows from the left cavity volume, B from the right one.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.surface import LabelledSurface, enclosed_volume
from heartfit.geometry.topology import orient

PATCH_AZIMUTH = np.deg2rad(78.0)
PATCH_DEPTH = np.deg2rad(65.0)
ROUNDING = 3e-3
HALF_PATCH = 14
OUTSIDE_PATCH = 26
ROWS = 28
MILLILITRE = 1e-6


@dataclass(frozen=True)
class ParametricVentricles:
    """Both ventricles at end diastole.

    edv, rv_edv: cavity volumes in m^3; wall_thickness, rv_wall_thickness in m; sphericity: length of the left
    cavity over its diameter. Raises InputError for a size that no ventricle has.
    """

    edv: float
    wall_thickness: float
    sphericity: float
    rv_edv: float
    rv_wall_thickness: float

    def __post_init__(self) -> None:
        _require("edv", self.edv, 20 * MILLILITRE, 600 * MILLILITRE, "m^3")
        _require("rv_edv", self.rv_edv, 20 * MILLILITRE, 600 * MILLILITRE, "m^3")
        _require("wall_thickness", self.wall_thickness, 3e-3, 30e-3, "m")
        _require("rv_wall_thickness", self.rv_wall_thickness, 1e-3, 15e-3, "m")
        _require("sphericity", self.sphericity, 0.8, 3.0, "")

    def surface(self) -> LabelledSurface:
        """The closed wall surface; base in the plane z = 0, apex towards -z, right ventricle towards +x.

        Raises InputError when the right cavity does not fit beside the left one.
        """
        from scipy.optimize import brentq

        a = self._radius()

        def excess(bulge: float) -> float:
            surface = self._build(a, bulge)
            return Cavity.of(surface, "rv_endo").volume(surface.points) - self.rv_edv

        if excess(4.0 * a) < 0.0:
            raise InputError(
                f"rv_edv {self.rv_edv:g} m^3 does not fit beside edv {self.edv:g} m^3; make it smaller"
            )
        return self._build(a, float(brentq(excess, 1e-3 * a, 4.0 * a, xtol=1e-6 * a)))

    def _radius(self) -> float:
        """Radius a in m of the left cavity at the base; the volume of the faceted cavity grows with a^3."""
        unit = self._build(1.0, 1.0)
        return float(np.cbrt(self.edv / Cavity.of(unit, "lv_endo").volume(unit.points)))

    def _build(self, a: float, bulge: float) -> LabelledSurface:
        sheet = _Sheets(a, 2.0 * self.sphericity * a, self.wall_thickness, self.rv_wall_thickness, bulge)
        eta, phi = np.meshgrid(np.linspace(0.0, np.pi / 2, ROWS), _azimuths(), indexing="ij")
        patch = _patch_angles()
        rim = (np.zeros_like(_azimuths()), _azimuths())
        sheets = [
            ("lv_endo", sheet.left_endo(eta, phi)),
            ("epi", sheet.epi(eta, phi)),
            ("rv_endo", sheet.left_epi(*patch)),
            ("rv_endo", sheet.right_endo(*patch)),
            ("base", np.stack([sheet.left_endo(*rim), sheet.left_epi(*rim)])),
            ("base", np.stack([sheet.right_endo(*rim), sheet.epi(*rim)])),
        ]
        return _sew(sheets)


@dataclass(frozen=True)
class _Sheets:
    """Points (..., 3) of the four sheets at the angles (eta, phi)."""

    a: float
    c: float
    wall: float
    right_wall: float
    bulge: float

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


def _smooth_positive(x: Floats) -> Floats:
    """The maximum of x and 0, rounded over ROUNDING: (x + sqrt(x^2 + s^2)) / 2."""
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


def _sew(sheets: list[tuple[str, Floats]]) -> LabelledSurface:
    """One closed surface from grids (i,j,3) of points, joined where their points coincide to a nanometre."""
    points = np.concatenate([grid.reshape(-1, 3) for _, grid in sheets])
    _, first, merged = np.unique(np.round(points * 1e9), axis=0, return_index=True, return_inverse=True)
    start = np.cumsum([0] + [grid.shape[0] * grid.shape[1] for _, grid in sheets])
    triangles = [
        _grid_triangles(grid.shape[0], grid.shape[1]) + s for (_, grid), s in zip(sheets, start, strict=False)
    ]
    labels = np.repeat([name for name, _ in sheets], [len(part) for part in triangles])
    joined = merged.reshape(-1)[np.concatenate(triangles)]
    whole = (joined != np.roll(joined, 1, axis=1)).all(axis=1)
    oriented = orient(joined[whole].astype(np.int64))
    if enclosed_volume(points[first], oriented) < 0.0:
        oriented = oriented[:, ::-1]
    return LabelledSurface(points[first], oriented, labels[whole])


def _grid_triangles(rows: int, columns: int) -> Integers:
    node = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]
    return np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])


def _require(name: str, value: float, low: float, high: float, unit: str) -> None:
    if not low <= value <= high:
        raise InputError(
            f"{name} = {value:g} {unit}: expected between {low:g} and {high:g} {unit}; check its unit"
        )

"""Ventricles from a handful of clinical numbers: a truncated ellipsoid with a crescent-shaped pocket.

Everything is a radius along rays from the centre of the flat base, x = r d(eta, phi), with the eccentric
angle eta of the left epicardium (0 base, pi/2 apex) and the azimuth phi (0 at the middle of the septum):

    r1, r2 : left endocardium and epicardium, ellipsoids of semi-axes (a, c) and (a + w, c + w)
    r3 = r2 + B (1 - q^2) / n.d,   q^2 = (phi / phi0)^2 + (eta / eta0)^2        right free wall, inside q < 1
    r4 = smooth maximum of r2 and r3 + t / n.d                                   epicardium of both ventricles

with the outward normal n of the left epicardium. a follows from the left cavity volume, B from the right one.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

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
        """Radius a in m of the left cavity at the base; the volume of one shape grows with a^3."""
        unit = self._build(1.0, 1.0)
        return float(np.cbrt(self.edv / Cavity.of(unit, "lv_endo").volume(unit.points)))

    def _build(self, a: float, bulge: float) -> LabelledSurface:
        radii = _Radii(a, 2.0 * self.sphericity * a, self.wall_thickness, self.rv_wall_thickness, bulge)
        eta, phi = np.meshgrid(np.linspace(0.0, np.pi / 2, ROWS), _azimuths(), indexing="ij")
        patch = _patch_angles()
        rim = (np.zeros_like(_azimuths()), _azimuths())
        sheets = [
            ("lv_endo", radii.left_endo(eta, phi)),
            ("epi", radii.epi(eta, phi)),
            ("rv_endo", radii.left_epi(*patch)),
            ("rv_endo", radii.right_endo(*patch)),
            ("base", np.stack([radii.left_endo(*rim), radii.left_epi(*rim)])),
            ("base", np.stack([radii.right_endo(*rim), radii.epi(*rim)])),
        ]
        return _sew(sheets)


@dataclass(frozen=True)
class _Radii:
    """Points (..., 3) of the four sheets at the angles (eta, phi)."""

    a: float
    c: float
    wall: float
    right_wall: float
    bulge: float

    def left_endo(self, eta: Floats, phi: Floats) -> Floats:
        d = self._direction(eta, phi)
        r1 = 1.0 / np.sqrt((d[..., 0] ** 2 + d[..., 1] ** 2) / self.a**2 + d[..., 2] ** 2 / self.c**2)
        return r1[..., None] * d

    def left_epi(self, eta: Floats, phi: Floats) -> Floats:
        across = (self.a + self.wall) * np.cos(eta)
        return np.stack(
            [across * np.cos(phi), across * np.sin(phi), -(self.c + self.wall) * np.sin(eta)], axis=-1
        )

    def right_endo(self, eta: Floats, phi: Floats) -> Floats:
        return self._beyond_left_epi(eta, phi, lambda pocket, _: np.maximum(pocket, 0.0))

    def epi(self, eta: Floats, phi: Floats) -> Floats:
        return self._beyond_left_epi(eta, phi, lambda pocket, wall: _smooth_positive(pocket + wall))

    def _beyond_left_epi(
        self, eta: Floats, phi: Floats, distance: Callable[[Floats, Floats], Floats]
    ) -> Floats:
        pocket = self.bulge * (1.0 - (phi / PATCH_AZIMUTH) ** 2 - (eta / PATCH_DEPTH) ** 2)
        slant = 1.0 / self._normal_along_ray(eta, phi)
        beyond = distance(pocket * slant, self.right_wall * slant)
        return self.left_epi(eta, phi) + beyond[..., None] * self._direction(eta, phi)

    def _direction(self, eta: Floats, phi: Floats) -> Floats:
        point = self.left_epi(eta, phi)
        return point / np.linalg.norm(point, axis=-1, keepdims=True)

    def _normal_along_ray(self, eta: Floats, phi: Floats) -> Floats:
        """n.d, the cosine between the left epicardium's normal and the ray."""
        across, along = self.a + self.wall, self.c + self.wall
        normal = self.left_epi(eta, phi) / np.array([across**2, across**2, along**2])
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        return (normal * self._direction(eta, phi)).sum(axis=-1)


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

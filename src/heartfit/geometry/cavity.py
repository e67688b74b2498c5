"""Cavity volume behind an endocardium, and its gradient: the load vector of a unit pressure."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats, Integers
from heartfit.core.errors import InputError
from heartfit.geometry.surface import rim_loops


class HasSurfaces(Protocol):
    """A mesh or a labelled surface: anything with triangles by surface name."""

    @property
    def surfaces(self) -> Mapping[str, Integers]: ...


@dataclass(frozen=True, eq=False)
class Cavity:
    """A cavity bounded by an endocardial surface, whose openings are closed by fans from their centroids.

    V(x) = -1/6 sum a.(b x c) over the triangles of endocardium and lids, whose normals point into the cavity.
    A lid's apex is the mean of its rim nodes, so the pressure on the lid is spread over the rim.
    triangles (k,3) refer to the nodes followed by one apex per opening; rim (r,) holds the nodes of all
    openings, rim_start (o+1,) the start of each opening in it.
    """

    triangles: Integers
    rim: Integers
    rim_start: Integers

    @property
    def lids(self) -> Integers:
        """The triangles (l,3) of the fans that close the openings."""
        return self.triangles[(self.triangles < 0).any(axis=1)]

    @classmethod
    def from_endocardium(cls, mesh: HasSurfaces, name: str) -> "Cavity":
        """Return the cavity behind the endocardium `name`; raises InputError if it has no or pinched openings."""
        surface = mesh.surfaces[name]
        loops = rim_loops(surface)
        if not loops:
            raise InputError(f"cavity {name}: the surface has no opening; expected at least one valve ring")
        lids = [
            np.column_stack([np.roll(loop, -1), loop, np.full(len(loop), -1 - opening)])
            for opening, loop in enumerate(loops)
        ]
        start = np.cumsum([0, *map(len, loops)])
        return cls(np.vstack([surface, *lids]).astype(np.int64), np.concatenate(loops), start)

    def corners(self, x: Floats) -> Floats:
        """Return the nodes x (n,3) followed by the lids' apices, to which negative ``triangles`` entries refer."""
        return _with_lid_apices(x, self.rim, self.rim_start)

    def volume(self, x: Floats) -> float:
        """Volume [m^3] at nodal positions x (n,3)."""
        return float(_volume(x, self.triangles, self.rim, self.rim_start))

    def gradient(self, x: Floats) -> Floats:
        """Gradient dV/dx (n,3) [m^2] at nodal positions x (n,3)."""
        return _gradient(x, self.triangles, self.rim, self.rim_start)


@njit(cache=True)
def _with_lid_apices(x: Floats, rim: Integers, start: Integers) -> Floats:
    """Return the nodes, then the lids' apices from the last opening to the first: index -1 - o is opening o."""
    n, openings = len(x), len(start) - 1
    corners = np.zeros((n + openings, 3))
    for i in range(n):
        for axis in range(3):
            corners[i, axis] = x[i, axis]
    for opening in range(openings):
        size = start[opening + 1] - start[opening]
        for i in range(start[opening], start[opening + 1]):
            for axis in range(3):
                corners[-1 - opening, axis] += x[rim[i], axis] / size
    return corners


@njit(cache=True)
def _volume(x: Floats, triangles: Integers, rim: Integers, start: Integers) -> float:
    corners = _with_lid_apices(x, rim, start)
    six_volumes = 0.0
    for t in range(len(triangles)):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            six_volumes -= corners[a, i] * (corners[b, j] * corners[c, k] - corners[b, k] * corners[c, j])
    return six_volumes / 6.0


@njit(cache=True)
def _gradient(x: Floats, triangles: Integers, rim: Integers, start: Integers) -> Floats:
    corners = _with_lid_apices(x, rim, start)
    gradient = np.zeros_like(corners)
    for t in range(len(triangles)):
        for corner in range(3):
            a, b, c = triangles[t, corner], triangles[t, (corner + 1) % 3], triangles[t, (corner + 2) % 3]
            for i in range(3):
                j, k = (i + 1) % 3, (i + 2) % 3
                cross = corners[b, j] * corners[c, k] - corners[b, k] * corners[c, j]
                gradient[a, i] -= cross / 6.0
    for opening in range(len(start) - 1):
        size = start[opening + 1] - start[opening]
        for i in range(start[opening], start[opening + 1]):
            for axis in range(3):
                gradient[rim[i], axis] += gradient[-1 - opening, axis] / size
    return gradient[: len(x)]

"""The volume of blood behind an endocardial surface, and its derivative: the load vector of a unit pressure."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numba import njit

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.topology import rim_loops


class HasSurfaces(Protocol):
    """A mesh or a labelled surface."""

    @property
    def surfaces(self) -> Mapping[str, Integers]: ...


@dataclass(frozen=True, eq=False)
class Cavity:
    """A cavity bounded by an endocardial surface, whose openings are closed by fans from their centroids.

    V(x) = -1/6 sum a.(b x c) over the triangles of endocardium and lids, whose normals point into the cavity.
    A lid's apex is the mean of its rim nodes, so the pressure on the lid is spread over the rim.
    triangles (k,3) refer to the nodes followed by one apex per opening; rim (r,) holds the nodes of all openings,
    rim_start (o+1,) where each opening begins in it.
    """

    triangles: Integers
    rim: Integers
    rim_start: Integers

    @classmethod
    def of(cls, mesh: HasSurfaces, name: str) -> "Cavity":
        """The cavity behind the endocardium `name`; raises InputError if that surface has no or pinched openings."""
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

    def volume(self, x: Floats) -> float:
        """Volume in m^3 at nodal positions x (n,3)."""
        return float(_volume(x, self.triangles, self.rim, self.rim_start))

    def gradient(self, x: Floats) -> Floats:
        """dV/dx (n,3) in m^2 at nodal positions x (n,3)."""
        return _gradient(x, self.triangles, self.rim, self.rim_start)


@njit(cache=True)
def _lid_apices(x: Floats, rim: Integers, start: Integers) -> Floats:
    apices = np.zeros((len(start) - 1, 3))
    for opening in range(len(start) - 1):
        for i in range(start[opening], start[opening + 1]):
            apices[opening] += x[rim[i]] / (start[opening + 1] - start[opening])
    return apices


@njit(cache=True)
def _corner(x: Floats, apices: Floats, node: int) -> Floats:
    return x[node] if node >= 0 else apices[-1 - node]


@njit(cache=True)
def _cross(a: Floats, b: Floats) -> tuple[float, float, float]:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@njit(cache=True)
def _volume(x: Floats, triangles: Integers, rim: Integers, start: Integers) -> float:
    apices = _lid_apices(x, rim, start)
    six_volumes = 0.0
    for t in range(len(triangles)):
        a = _corner(x, apices, triangles[t, 0])
        n = _cross(_corner(x, apices, triangles[t, 1]), _corner(x, apices, triangles[t, 2]))
        six_volumes -= a[0] * n[0] + a[1] * n[1] + a[2] * n[2]
    return six_volumes / 6.0


@njit(cache=True)
def _gradient(x: Floats, triangles: Integers, rim: Integers, start: Integers) -> Floats:
    apices = _lid_apices(x, rim, start)
    gradient, of_apices = np.zeros_like(x), np.zeros_like(apices)
    for t in range(len(triangles)):
        for i in range(3):
            node, b, c = triangles[t, i], triangles[t, (i + 1) % 3], triangles[t, (i + 2) % 3]
            n = _cross(_corner(x, apices, b), _corner(x, apices, c))
            target = gradient[node] if node >= 0 else of_apices[-1 - node]
            for d in range(3):
                target[d] -= n[d] / 6.0
    for opening in range(len(start) - 1):
        for i in range(start[opening], start[opening + 1]):
            gradient[rim[i]] += of_apices[opening] / (start[opening + 1] - start[opening])
    return gradient

r"""Structured tetrahedra for the problems of Land et al.: half a beam and a truncated ellipsoid.

The ventricle is the wall between the ellipsoids of half-axes

.. math:: r_s = 7 + 3 t, \quad r_l = 17 + 3 t \text{ (mm)}, \qquad
          x = (r_s \sin w \cos v,\ r_s \sin w \sin v,\ -r_l \cos w), \qquad 0 \le t \le 1,

cut at z = 5 mm; w = 0 is the apex. Rings of constant w around the apex are joined by triangles, these are extruded
across the wall and cut into three tetrahedra each. Fibres turn from +90 degrees at t = 0 to -90 degrees at t = 1 about
the normal, counted from the parallel to the meridian, and are taken at the centroid.

The three problems of the N-version benchmark of cardiac mechanics, with the elements and the steps of the wall.

1. A beam of 10 x 1 x 1 mm, clamped at x = 0, fibres along x, under 4 Pa from below; the result is its tip, the point
   (10, 0.5, 1) mm. Half of it is solved, u_y = 0 in the plane of symmetry.
2. A truncated ellipsoid of isotropic tissue, clamped at its base, under 10 kPa; the results are its apices, the nodes
   on the axis at endocardium and epicardium.
3. The same with fibres turning by 180 degrees, under 15 kPa and a second Piola-Kirchhoff stress of 60 kPa along them.

The benchmark is incompressible; here K = 100 MPa. G, with which the wall pressure is stabilised, is of the order of the
loaded tissue's shear modulus: the exponential law stiffens more than tenfold, and the modulus at rest would smooth the
pressure. In problem 3 on its middle mesh 8, 32 and 128 kPa put the endocardial apex at -12.02, -12.20 and -12.33 mm;
the difference vanishes with refinement. The expected numbers are those of the participant Simula-FEniCS,
cubic to quintic elements, as published with the benchmark: converged to the digits given.
Source: Land et al., Proc. R. Soc. A 471 (2015) 20150641, and the participants' results published with it.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np
import pandas as pd
from skfem import MeshTet

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.cube import bare_mesh, oriented
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.surface import boundary_faces
from heartfit.heart.muscle.guccione import Guccione
from verification.check import Check
from verification.equilibrium import Loading, equilibrium

MM = 1e-3
BASE = 5.0 * MM
WALL = 3.0 * MM


def half_beam(n_x: int, n_y: int, n_z: int) -> VentricularMesh:
    """10 x 0.5 x 1 mm, fibres along x, elements shorter towards the clamp at x = 0; ``lv_endo`` is the bottom."""
    axes = (10.0 * np.linspace(0.0, 1.0, n_x + 1) ** 1.5, np.linspace(0.0, 0.5, n_y + 1))
    grid = MeshTet.init_tensor(*(MM * axis for axis in axes), MM * np.linspace(0.0, 1.0, n_z + 1))
    points, tets = np.ascontiguousarray(grid.p.T), grid.t.T.astype(np.int64)
    tets = oriented(points, tets)
    shell = boundary_faces(tets)
    centres = points[shell].mean(axis=1) / MM
    places = {"lv_endo": (2, 0.0), "rv_endo": (2, 1.0), "base": (0, 0.0), "epi": (0, 10.0)}
    surfaces = {name: shell[np.isclose(centres[:, axis], at)] for name, (axis, at) in places.items()}
    return bare_mesh(points, tets, surfaces, np.tile([1.0, 0.0, 0.0], (len(tets), 1)))


def ventricle(rings: int, sextant: int, layers: int, refined: float = 1.0) -> VentricularMesh:
    """The truncated ellipsoid with ``layers`` across the wall and ``rings`` from apex to base.

    Up to ring ``sextant`` each has six nodes more than the one before. ``refined`` > 1 concentrates rings at the apex
    and layers at the endocardium. The apices are the first node of the first and of the last layer; ``rv_endo``
    is the epicardium once more: there is no second cavity.
    """
    ring, angle, triangles = _disc(rings, sextant)
    depths = np.linspace(0.0, 1.0, layers + 1) ** refined
    points = np.concatenate([_layer(t, (ring / rings) ** refined, angle) for t in depths])
    tets = oriented(points, _extruded(triangles, len(ring), layers))
    fibres = fibre_direction(points[tets].mean(axis=1), np.repeat(depths, len(ring))[tets].mean(axis=1))
    return bare_mesh(points, tets, _surfaces(tets, ring, layers), fibres)


def fibre_direction(points: Floats, depth: Floats) -> Floats:
    """Unit fibres (m, 3) at points (m, 3) of the transmural coordinate ``depth`` (m,)."""
    r_s, r_l = 7.0 * MM + WALL * depth, 17.0 * MM + WALL * depth
    v = np.arctan2(points[:, 1], points[:, 0])
    w = np.arctan2(np.hypot(points[:, 0], points[:, 1]) / r_s, -points[:, 2] / r_l)
    meridian = np.stack([r_s * np.cos(w) * np.cos(v), r_s * np.cos(w) * np.sin(v), r_l * np.sin(w)])
    parallel, angle = np.stack([-np.sin(v), np.cos(v), np.zeros_like(v)]), 0.5 * np.pi * (1.0 - 2.0 * depth)
    fibres: Floats = np.sin(angle) * meridian / np.linalg.norm(meridian, axis=0) + np.cos(angle) * parallel
    return fibres.T


def _layer(t: float, latitude: Floats, angle: Floats) -> Floats:
    r_s, r_l = 7.0 * MM + WALL * t, 17.0 * MM + WALL * t
    w = latitude * (np.pi - np.arccos(BASE / r_l))
    return np.column_stack(
        [r_s * np.sin(w) * np.cos(angle), r_s * np.sin(w) * np.sin(angle), -r_l * np.cos(w)]
    )


def _disc(rings: int, sextant: int) -> tuple[Integers, Floats, Integers]:
    """Ring (n,) and angle (n,) of the nodes of a disc, its centre first, and its triangles (k, 3)."""
    counts = np.array([1] + [6 * min(k, sextant) for k in range(1, rings + 1)])
    starts = np.cumsum(counts) - counts
    angle = np.concatenate([2.0 * np.pi * np.arange(count) / count for count in counts])
    strips = [_strip(starts[k], counts[k], starts[k + 1], counts[k + 1]) for k in range(rings)]
    return np.repeat(np.arange(rings + 1), counts), angle, np.concatenate(strips)


def _strip(inner: int, a: int, outer: int, b: int) -> Integers:
    """Triangles between a ring of ``a`` nodes from ``inner`` on and one of ``b`` nodes from ``outer`` on."""
    triangles, i, j = [], 0, 0
    steps = a if a > 1 else 0
    while i < steps or j < b:
        here = inner + i % a, outer + j % b
        if j < b and (i >= steps or (j + 1) * a <= (i + 1) * b):
            j += 1
            triangles.append((*here, outer + j % b))
        else:
            i += 1
            triangles.append((*here, inner + i % a))
    return np.array(triangles)


def _extruded(triangles: Integers, nodes: int, layers: int) -> Integers:
    """Prisms cut alike on both sides of each face, since their corners are taken in the order of the nodes."""
    a, b, c = np.sort(triangles, axis=1).T
    prism = np.stack(
        [[a, b, c, c + nodes], [a, b, b + nodes, c + nodes], [a, a + nodes, b + nodes, c + nodes]]
    )
    once = prism.transpose(0, 2, 1).reshape(-1, 4)
    return np.concatenate([once + nodes * layer for layer in range(layers)]).astype(np.int64)


def _surfaces(tets: Integers, ring: Integers, layers: int) -> dict[str, Integers]:
    shell = boundary_faces(tets)
    layer, place = np.divmod(shell, len(ring))
    endo, epi = (layer == 0).all(axis=1), (layer == layers).all(axis=1)
    base = (ring[place] == ring.max()).all(axis=1)
    return {"lv_endo": shell[endo], "rv_endo": shell[epi], "epi": shell[epi], "base": shell[base]}


INCOMPRESSIBLE = 1e8
Size = tuple[int, int, int]


@dataclass(frozen=True, eq=False)
class Problem:
    """A load for each mesh of ``sizes``, coarse to fine, and the ``expected`` results with their evaluation."""

    title: str
    sizes: tuple[Size, Size, Size]
    load: Callable[[Size], Loading]
    read: Callable[[Loading, Floats], tuple[float, ...]]
    expected: Mapping[str, float]

    @cache  # noqa: B019 the problems are constants
    def answers(self, size: Size) -> dict[str, float]:
        """Measured results on the mesh of ``size``, by the names of the expected ones; raises StepFailed."""
        loading = self.load(size)
        return dict(zip(self.expected, self.read(loading, equilibrium(loading)), strict=True))

    def deviation(self, name: str, size: Size) -> float:
        """Deviation of a result from the expected one [%]."""
        return 100.0 * (self.answers(size)[name] / self.expected[name] - 1.0)


def bent_beam(size: Size) -> Loading:
    """Problem 1; the strains are small, so the pressure is stabilised with the modulus at rest."""
    mesh = half_beam(*size)
    held = np.repeat((mesh.points[:, 0] < 1e-9)[:, None], 3, axis=1)
    held[:, 1] |= mesh.points[:, 1] > 0.5 * MM - 1e-9
    return Loading(mesh, Guccione(K=INCOMPRESSIBLE, G=2e3), held, mesh.surfaces["lv_endo"], pressure=4.0)


def inflated_ventricle(size: Size) -> Loading:
    """Problem 2."""
    law = Guccione(C=10e3, b_f=1.0, b_t=1.0, b_fs=1.0, K=INCOMPRESSIBLE, G=20e3)
    mesh = ventricle(*size)
    return Loading(mesh, law, _at_base(mesh.points), mesh.surfaces["lv_endo"], pressure=10e3)


def contracting_ventricle(size: Size) -> Loading:
    """Problem 3; the fibres have no direction at the apex, so there the mesh is fine."""
    mesh, law = ventricle(*size, refined=1.5), Guccione(K=INCOMPRESSIBLE, G=30e3)
    return Loading(mesh, law, _at_base(mesh.points), mesh.surfaces["lv_endo"], pressure=15e3, tension=60e3)


def _at_base(points: Floats) -> np.ndarray:
    return np.repeat((points[:, 2] > 5.0 * MM - 1e-9)[:, None], 3, axis=1)


def _tip(loading: Loading, x: Floats) -> tuple[float]:
    corner = int(np.argmax(loading.mesh.points.sum(axis=1)))
    return (float(x[corner, 2] / MM),)


def _apices(loading: Loading, x: Floats) -> tuple[float, float, float]:
    positions, mesh = loading.mesh.points + x[:, :3], loading.mesh
    axis = np.flatnonzero(np.hypot(*mesh.points[:, :2].T) < 1e-9)
    volume = Cavity.from_endocardium(mesh, "lv_endo").volume(positions)
    return float(positions[axis[0], 2] / MM), float(positions[axis[-1], 2] / MM), 1e6 * volume


APICES = ("endocardial apex z, mm", "epicardial apex z, mm")
VOLUME = "cavity, mL"
PROBLEMS = (
    Problem(
        "beam, 4 Pa",
        ((40, 2, 8), (80, 3, 16), (110, 4, 24)),
        bent_beam,
        _tip,
        {"deflection of the tip, mm": 3.169},
    ),
    Problem(
        "ventricle, 10 kPa",
        ((8, 4, 2), (12, 6, 3), (16, 8, 4)),
        inflated_ventricle,
        _apices,
        dict(zip((*APICES, VOLUME), (-26.612, -28.279, 10.734), strict=True)),
    ),
    Problem(
        "ventricle, 15 kPa and tension of 60 kPa",
        ((8, 4, 3), (12, 6, 4), (16, 8, 6)),
        contracting_ventricle,
        _apices,
        dict(zip((*APICES, VOLUME), (-12.347, -15.452, 1.796), strict=True)),
    ),
)

COARSE, FINE = 5.0, 1.0
"""Tolerances, %: that of the coarse mesh is its discretisation error."""

SOURCE = "Land et al. 2015, Simula-FEniCS"


def coarse_land_checks() -> list[Check]:
    """Check the coarsest meshes, 2 s of computing."""
    return [row for problem in PROBLEMS for row in _rows(problem, problem.sizes[0], COARSE)]


def fine_land_checks() -> list[Check]:
    """Check the finest meshes, half a minute of computing."""
    return [row for problem in PROBLEMS for row in _rows(problem, problem.sizes[-1], FINE)]


def land_table() -> pd.DataFrame:
    """Results on the meshes, coarse to fine, and their deviations from the expected ones."""
    rows = [_line(problem, name) for problem in PROBLEMS for name in problem.expected]
    return pd.DataFrame(rows, columns=["problem", "result", "coarse", "middle", "fine", "expected"])


def _rows(problem: Problem, size: Size, tolerance: float) -> list[Check]:
    expected_names = [name for name in problem.expected if name != VOLUME]
    named = {f"{problem.title}: {name.rsplit(',', 1)[0]} off, {_mesh(size)}": name for name in expected_names}
    return [
        Check(row, problem.deviation(name, size), 0.0, tolerance, "%", SOURCE) for row, name in named.items()
    ]


def _line(problem: Problem, name: str) -> tuple[str, ...]:
    cells = [
        f"{problem.answers(size)[name]:.2f} ({problem.deviation(name, size):+.1f} %)"
        for size in problem.sizes
    ]
    return problem.title, name, *cells, f"{problem.expected[name]:.2f}"


def _mesh(size: Size) -> str:
    return " x ".join(map(str, size))

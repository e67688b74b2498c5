r"""The three problems of the N-version benchmark of cardiac mechanics, with the elements and the steps of the wall.

1. A beam of 10 x 1 x 1 mm, clamped at x = 0, fibres along x, under 4 Pa from below; asked for is its tip, the point
   (10, 0.5, 1) mm. Half of it is solved, u_y = 0 in the plane of symmetry.
2. A truncated ellipsoid of isotropic tissue, clamped at its base, under 10 kPa; asked for are its apices, the nodes on
   the axis at endocardium and epicardium.
3. The same with fibres turning by 180 degrees, under 15 kPa and a second Piola-Kirchhoff stress of 60 kPa along them.

The benchmark is incompressible; here K = 100 MPa. G, with which the wall pressure is stabilised, is of the order of the
loaded tissue's shear modulus: the exponential law stiffens more than tenfold, and the modulus at rest would blur the
pressure. In problem 3 on its middle mesh 8, 32 and 128 kPa put the endocardial apex at -12.02, -12.20 and -12.33 mm;
the difference goes with the mesh. The expected numbers are those of the participant Simula-FEniCS,
cubic to quintic elements, as published with the benchmark: converged to the digits given.
Source: Land et al., Proc. R. Soc. A 471 (2015) 20150641, and the participants' results published with it.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.geometry.cavity import Cavity
from heartfit.mechanics.passive.guccione import Guccione
from heartfit.verification.equilibrium import Loading, equilibrium
from heartfit.verification.land_meshes import MM, half_beam, ventricle

INCOMPRESSIBLE = 1e8
Size = tuple[int, int, int]


@dataclass(frozen=True, eq=False)
class Problem:
    """A load for each mesh of ``sizes``, coarse to fine, and how the ``expected`` answers are read from it."""

    title: str
    sizes: tuple[Size, Size, Size]
    load: Callable[[Size], Loading]
    read: Callable[[Loading, Floats], tuple[float, ...]]
    expected: Mapping[str, float]

    @cache  # noqa: B019 the problems are constants
    def answers(self, size: Size) -> dict[str, float]:
        """Measured on the mesh of ``size``, by the names of the expected; raises StepFailed."""
        loading = self.load(size)
        return dict(zip(self.expected, self.read(loading, equilibrium(loading)), strict=True))

    def deviation(self, name: str, size: Size) -> float:
        """Of an answer from the expected one, %."""
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
    volume = Cavity.of(mesh, "lv_endo").volume(positions)
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

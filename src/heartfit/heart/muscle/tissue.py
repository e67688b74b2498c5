r"""The slots of the wall: active and passive law, control, right ventricle, and the support of the heart in the chest.

The support consists of springs and dampers at the valve rings, of the pericardium and of the stiff fibrous annuli. It
acts by Robin conditions on the reference surfaces, lumped to the nodes:

.. math:: t = -k_b u - c_b \dot u \text{ on the rings}, \qquad t = -k_p (\zeta) (u \cdot N) N \text{ on the epicardium.}

The pericardium slides; it is stiffer towards the apex, which is tied to the diaphragm.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.territory import REGIONS, RIGHT_VENTRICLE
from heartfit.heart.muscle.bcs import BestelClementSorine
from heartfit.heart.muscle.control import Control
from heartfit.heart.muscle.passive import MooneyRivlin, Passive
from heartfit.heart.muscle.right import SAME_MUSCLE, RightVentricle
from heartfit.heart.muscle.stiffened import Stiffened
from heartfit.roles import Amendment, Attachment, Availability, Delay, Mechanism, Relaxation, Stress


@dataclass(frozen=True)
class Support:
    """Stiffness and damping of the support, and the stiffening of the valve annuli."""

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
        """Nodal spring matrices (n, 3, 3) [N/m]."""
        epi = mesh.surfaces["epi"]
        normals = _area_normals(mesh.points, epi)
        areas = np.linalg.norm(normals, axis=1)
        unit = normals / areas[:, None]
        moduli = areas * self._pericardium(mesh, epi)
        dyads = moduli[:, None, None] * unit[:, :, None] * unit[:, None, :]
        return _lump(dyads, epi, len(mesh.points)) + self.k_b * self._rings(mesh)

    def damping(self, mesh: VentricularMesh) -> Floats:
        """Nodal damper matrices (n, 3, 3) [N.s/m]."""
        return self.c_b * self._rings(mesh)

    def passive_scale(self, mesh: VentricularMesh) -> Floats:
        """Factors (m,) on the passive moduli: the annuli are stiff collagen and carry the tension of the muscle."""
        rings = mesh.points[np.unique(mesh.surfaces["base"])]
        distance = _nearest_distances(mesh.points[mesh.tets].mean(axis=1), rings)
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
    """Normals (k, 3) of triangles, whose lengths are the areas [m^2]."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    normals: Floats = 0.5 * np.cross(b - a, c - a)
    return normals


def _lump(blocks: Floats, triangles: np.ndarray, nodes: int) -> Floats:
    """Nodal blocks (n, 3, 3): the blocks (k, 3, 3) of triangles, spread evenly over their corners."""
    result = np.zeros((nodes, 3, 3))
    for corner in range(3):
        np.add.at(result, triangles[:, corner], blocks / 3.0)
    return result


def _nearest_distances(points: Floats, others: Floats) -> Floats:
    """Distances (n,) of points from the nearest of ``others`` [m]; brute force beats the import of a k-d tree."""
    squares = (points**2).sum(axis=1)[:, None] + (others**2).sum(axis=1) - 2.0 * points @ others.T
    return np.sqrt(np.maximum(squares.min(axis=1), 0.0))


@dataclass(frozen=True)
class Tissue:
    """Tissue of the ventricles: passive and active law, control, right free wall, support and finite element.

    ``regional`` holds the mechanisms that differ between regions of the wall.
    """

    passive: Passive = field(default_factory=MooneyRivlin)
    active: BestelClementSorine = field(default_factory=BestelClementSorine)
    control: Control = field(default_factory=Control)
    right: RightVentricle = SAME_MUSCLE
    support: Support = field(default_factory=Support)
    element: str = "mixed"
    regional: tuple[Availability | Delay, ...] = ()

    @property
    def uniform(self) -> bool:
        """True if all regions of the wall are of the same muscle."""
        return not self.regional and self.right == SAME_MUSCLE

    def delays(self) -> Floats:
        """Delays (18,) of the activation of the regions [s]; see :class:`heartfit.roles.Delay`."""
        own = _in_right_wall(self.right.delay, np.zeros(REGIONS))
        return sum((effect.delay() for effect in self.regional if isinstance(effect, Delay)), own)

    def losses(self) -> Floats:
        """Shares (18,) of the bridges that are missing in the regions; negative where there are more of them."""
        kept = (1.0 - effect.lost_share() for effect in self.regional if isinstance(effect, Availability))
        return 1.0 - np.prod([*kept, _in_right_wall(self.right.contractility, np.ones(REGIONS))], axis=0)

    def stiffenings(self) -> Floats:
        """Factors (18,) on the passive moduli of the regions."""
        return _in_right_wall(self.right.stiffness, np.ones(REGIONS))

    def with_mechanisms(self, mechanisms: Sequence[Mechanism], period: float) -> "Tissue":
        """Tissue whose constants, stresses, tails and regions are amended by ``mechanisms``, at a ``period`` [s]."""
        amended = self
        for mechanism in (m for m in mechanisms if isinstance(m, Amendment)):
            amended = _amend(amended, mechanism.amends.split("."), partial(mechanism.amend, period=period))
        return amended._with_parts(mechanisms)

    def _with_parts(self, mechanisms: Sequence[Mechanism]) -> "Tissue":
        stresses = tuple(m for m in mechanisms if isinstance(m, Stress))
        gains = tuple(m for m in mechanisms if isinstance(m, Attachment))
        tails = tuple(m for m in mechanisms if isinstance(m, Relaxation))
        regional = tuple(m for m in mechanisms if isinstance(m, Availability | Delay))
        return replace(
            self,
            passive=Stiffened(self.passive, stresses) if stresses else self.passive,
            control=replace(self.control, gains=gains, tails=tails) if gains or tails else self.control,
            regional=regional,
        )


def _in_right_wall(value: float, others: Floats) -> Floats:
    """Values (18,) of the regions: those of ``others``, and ``value`` in the right wall."""
    others[RIGHT_VENTRICLE] = value
    return others


def _amend(part: Any, path: Sequence[str], amend: Callable[[float], float]) -> Any:
    """Copy of ``part`` with the constant at the end of the ``path`` amended."""
    name, *rest = path
    value = getattr(part, name)
    return replace(part, **{name: _amend(value, rest, amend) if rest else amend(value)})

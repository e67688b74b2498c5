"""Parts of a tissue for problems whose answer is known: fibres of given tension, nodes held where they are."""

from dataclasses import dataclass, field

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.mechanics.active.bcs import BestelClementSorine, Drive
from heartfit.mechanics.support import Support

CLAMP = 1e9
"""Springs, N/m, that leave a held node where it is in a Newton step; what they bear is no equation of the problem."""


@dataclass(frozen=True)
class ConstantTension(BestelClementSorine):
    """Fibres of the tension ``tension_of_fibres``, Pa, whatever their strain."""

    tension_of_fibres: float = 0.0

    def respond(self, drive: Drive, e_old: Floats, e_new: Floats, state: Floats, out: Floats) -> None:  # noqa: ARG002
        out[0], out[1:] = self.tension_of_fibres, 0.0


@dataclass(frozen=True)
class Held(Support):
    """Nothing but a clamp on the components ``held`` (n, 3) of the displacement."""

    held: np.ndarray = field(default_factory=lambda: np.zeros((0, 3), dtype=bool))

    def stiffness(self, mesh: VentricularMesh) -> Floats:  # noqa: ARG002
        result: Floats = CLAMP * self.held[:, :, None] * np.eye(3)
        return result

    def damping(self, mesh: VentricularMesh) -> Floats:
        return np.zeros((len(mesh.points), 3, 3))

    def passive_scale(self, mesh: VentricularMesh) -> Floats:
        return np.ones(len(mesh.tets))

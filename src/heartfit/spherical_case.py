"""A subject whose left ventricle is a sphere: the same law as on the mesh, a thousand times cheaper."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Self

import numpy as np

from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart import Heart
from heartfit.mechanics.passive.law import isotropic
from heartfit.mechanics.sphere import Sphere
from heartfit.observation.beat import observe_beats
from heartfit.observation.operator import CurveFeatures
from heartfit.simulation import Numerics
from heartfit.sphere.simulation import simulate_spheres

UNFILLED = "no stress-free sphere has this volume under the end-diastolic pressure"


@dataclass(frozen=True)
class SphericalCase:
    """What is fixed of the subject; calling it with parameters by name, SI, gives the observations of the beat.

    cavity, wall: volumes, m^3, at the end-diastolic ``pressure``, Pa; features: the operator of each curve that is
    observed. As in the study, the stress-free reference is found for the very parameters of each call. The right
    ventricle is left out: no observation sees it, and it reaches the left one through the septum only.
    """

    cavity: float
    wall: float
    pressure: float
    heart: Heart
    features: Mapping[str, CurveFeatures]
    numerics: Numerics = field(default_factory=Numerics)

    @classmethod
    def of(
        cls,
        mesh: VentricularMesh,
        pressure: float,
        heart: Heart,
        features: Mapping[str, CurveFeatures],
        numerics: Numerics,
    ) -> Self:
        """With the volumes of a mesh; the septum belongs to the left ventricle."""
        cavity = Cavity.of(mesh, "lv_endo").volume(mesh.points)
        wall = mesh.element_volumes()[np.asarray(mesh.segments) != 0].sum()
        return cls(float(cavity), float(wall), pressure, heart, features, numerics)

    def __call__(self, parameters: Mapping[str, float]) -> dict[str, float] | str:
        """The observations, or the reason why the beat failed."""
        heart = self.heart.with_parameters(parameters)
        try:
            sphere = Sphere.unloaded(self.cavity, self.wall, self.pressure, isotropic(heart.muscle.passive))
        except ValueError:
            return UNFILLED
        return observe_beats([simulate_spheres(heart, [sphere], self.numerics)], self.features)[0]

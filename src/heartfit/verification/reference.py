"""What the choice of the stress-free reference does to a beat.

The reference is found for the very parameters that beat ("own"), frozen at the standard c_1 while c_1 varies, or the
end-diastolic mesh is taken as stress-free, as the paper does. c_1 varies as at its sigma points for four parameters.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.catalogue import declared
from heartfit.geometry.arrays import Floats
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart import Heart
from heartfit.mechanics.body import CHAMBERS, FiniteElementBody
from heartfit.mechanics.unloading import unload
from heartfit.observation.beat import beat_curves
from heartfit.observation.operator import VolumeFeatures
from heartfit.observation.vector import cavity_indices
from heartfit.simulation import Numerics, simulate

SPREAD = 2.0
"""Distance of the sigma points in standard deviations, n being 4."""


@dataclass(frozen=True)
class Variant:
    """A heart whose ln c_1 is ``z`` standard deviations off, on one of three references."""

    name: str
    reference: str
    z: float = 0.0

    def heart(self) -> Heart:
        stiffness = declared("c_1")
        return Heart().with_parameters({"c_1": stiffness.value * np.exp(self.z * (stiffness.sd or 0.0))})


OWN, FROZEN, LOADED = "own", "frozen", "end_diastolic"
VARIANTS = (
    Variant("own", OWN),
    Variant("end-diastolic mesh, as the paper", LOADED),
    Variant("own, c_1 up", OWN, SPREAD),
    Variant("own, c_1 down", OWN, -SPREAD),
    Variant("frozen, c_1 up", FROZEN, SPREAD),
    Variant("frozen, c_1 down", FROZEN, -SPREAD),
)


@dataclass(frozen=True)
class Finding:
    """EDV of each ventricle over the measured one, and the observations of the left one's curve, SI."""

    filled: dict[str, float]
    observed: dict[str, float]


def find(
    mesh: VentricularMesh, pressures: Floats, numerics: Numerics, variants: tuple[Variant, ...] = VARIANTS
) -> dict[str, Finding]:
    """Findings by name of the variant; raises StepFailed if one cannot be unloaded, ValueError if it does not beat."""
    return {variant.name: _find(variant, mesh, pressures, numerics) for variant in variants}


def _find(variant: Variant, mesh: VentricularMesh, pressures: Floats, numerics: Numerics) -> Finding:
    heart = variant.heart()
    tissue = Heart().tissue if variant.reference == FROZEN else heart.muscle
    reference = mesh if variant.reference == LOADED else unload(mesh, tissue, pressures)
    curves = beat_curves(simulate(heart, FiniteElementBody(reference, heart.muscle), numerics))
    measured = {side: Cavity.of(mesh, f"{side}_endo").volume(mesh.points) for side in CHAMBERS}
    filled = {side: cavity_indices(curves, side)["EDV"] / measured[side] for side in CHAMBERS}
    return Finding(filled, VolumeFeatures()(curves["lv_volume"]))

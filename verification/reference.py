"""Effect of the stress-free reference on a beat.

The reference is computed for the parameters of the beat ("own"), or for the standard c_1 while c_1 varies ("frozen"),
or the end-diastolic mesh is assumed to be stress-free (the paper does not say which). c_1 varies as at its sigma
points for four parameters.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np
import pandas as pd

from heartfit.core.arrays import Floats
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements.body import CHAMBERS, FiniteElementBody
from heartfit.heart.finite_elements.unloading import inflate, unload
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.observation.beat import beat_curves
from heartfit.observation.operator import VolumeFeatures, cavity_indices
from heartfit.personalise.setting import declaration
from verification.check import Check
from verification.specimen import COARSE, END_DIASTOLIC_PRESSURE, specimen

SPREAD = 2.0
"""Distance of the sigma points in standard deviations, n being 4."""


@dataclass(frozen=True)
class Variant:
    """A heart with ln c_1 shifted by ``z`` standard deviations, on one of three references."""

    name: str
    reference: str
    z: float = 0.0

    def heart(self) -> Heart:
        stiffness = declaration("c_1")
        return Heart().with_parameters({"c_1": stiffness.value * np.exp(self.z * (stiffness.sd or 0.0))})


OWN, FROZEN, LOADED = "own", "frozen", "end_diastolic"
VARIANTS = (
    Variant("own", OWN),
    Variant("end-diastolic mesh", LOADED),
    Variant("own, c_1 up", OWN, SPREAD),
    Variant("own, c_1 down", OWN, -SPREAD),
    Variant("frozen, c_1 up", FROZEN, SPREAD),
    Variant("frozen, c_1 down", FROZEN, -SPREAD),
)


@dataclass(frozen=True)
class Finding:
    """EDV of each ventricle over the measured one, and the observations of the left one's curve [SI]."""

    filled: dict[str, float]
    observed: dict[str, float]


def find(
    mesh: VentricularMesh, pressures: Floats, numerics: Numerics, variants: tuple[Variant, ...] = VARIANTS
) -> dict[str, Finding]:
    """Results by name of the variant; raises StepFailed if one cannot be unloaded, ValueError if its beat fails."""
    return {variant.name: _find(variant, mesh, pressures, numerics) for variant in variants}


def _find(variant: Variant, mesh: VentricularMesh, pressures: Floats, numerics: Numerics) -> Finding:
    heart = variant.heart()
    tissue = Heart().tissue if variant.reference == FROZEN else heart.muscle
    reference = mesh if variant.reference == LOADED else unload(mesh, tissue, pressures)
    curves = beat_curves(simulate(heart, FiniteElementBody(reference, heart.muscle), numerics))
    measured = {side: Cavity.from_endocardium(mesh, f"{side}_endo").volume(mesh.points) for side in CHAMBERS}
    filled = {side: cavity_indices(curves, side)["EDV"] / measured[side] for side in CHAMBERS}
    return Finding(filled, VolumeFeatures()(curves["lv_volume"]))


COLUMNS = ["reference", "EDV, LV / RV", "V_min (mL)", "q_max (mL/s)", "q_min (mL/s)"]


def reference_checks() -> list[Check]:
    """Checks of the exact inversion, and of the deviations of other references from it."""
    findings, bound = first_beats(), "a bound: {}"
    overfilled = _filled(findings, "end-diastolic mesh") / _filled(findings, "own")
    return [
        Check(
            "reference: volume refilled over the measured one", refilled(), 1.0, 1e-3, "1", "it was measured"
        ),
        Check(
            "reference: EDV, c_1 up over down", _spread(findings, "own"), 1.0, 0.03, "1", "it was measured"
        ),
        Check(
            "reference: the same, frozen",
            _spread(findings, FROZEN),
            0.91,
            0.04,
            "1",
            bound.format("it follows c_1"),
        ),
        Check(
            "reference: EDV, end-diastolic mesh over own",
            overfilled,
            1.13,
            0.04,
            "1",
            bound.format("overfilled"),
        ),
        Check(
            "reference: V_min by c_1, frozen over own",
            _slope(findings),
            0.7,
            0.1,
            "1",
            bound.format("blunted"),
        ),
    ]


@cache
def refilled() -> float:
    """Static volume of the left cavity under the pressures for which the coarse specimen was unloaded, relative."""
    mesh, tissue = specimen(COARSE), Heart().tissue
    body = FiniteElementBody(unload(mesh, tissue, END_DIASTOLIC_PRESSURE), tissue)
    filled = body.volumes(inflate(body, END_DIASTOLIC_PRESSURE).x)[0]
    return float(filled / body.cavities[0].volume(mesh.points))


@cache
def first_beats() -> dict[str, Finding]:
    """Run one beat of each variant of the coarse specimen at 10 ms."""
    return find(specimen(COARSE), END_DIASTOLIC_PRESSURE, Numerics(time_step=1e-2, max_beats=1))


def reference_table(findings: Mapping[str, Finding]) -> pd.DataFrame:
    """Return a row for each result."""
    return pd.DataFrame([_row(name, finding) for name, finding in findings.items()], columns=COLUMNS)


def _row(name: str, finding: Finding) -> tuple[str, ...]:
    filled = " / ".join(f"{100 * (ratio - 1):+.1f} %" for ratio in finding.filled.values())
    return name, filled, *(f"{1e6 * value:.0f}" for value in finding.observed.values())


def _filled(findings: Mapping[str, Finding], name: str) -> float:
    return findings[name].filled["lv"]


def _spread(findings: Mapping[str, Finding], reference: str) -> float:
    return _filled(findings, f"{reference}, c_1 up") / _filled(findings, f"{reference}, c_1 down")


def _slope(findings: Mapping[str, Finding]) -> float:
    slopes = [
        findings[f"{name}, c_1 up"].observed["V_min"] - findings[f"{name}, c_1 down"].observed["V_min"]
        for name in ("frozen", "own")
    ]
    return slopes[0] / slopes[1]

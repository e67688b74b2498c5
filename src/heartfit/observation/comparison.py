"""What registration makes of a motion that is known: volumes, strain, places and folds.

The paper's section 4.3: a simulated motion, synthetic images of it, and the motion that registration finds in them.
Both are taken at the frames of the images, so what the sampling itself hides is not in the errors: the observation
operator takes simulated curves at the same frames.

Reference: Marchesseau et al. 2012, section 4.3.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures
from heartfit.observation.pair import Pair, Reading
from heartfit.observation.strain import segment_strain
from heartfit.observation.volumes import cavity_volumes
from heartfit.registration.carry import inverted_elements

SAME_TIME = 1e-3
"""s; headers of images round trigger times to it."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """One motion, true and registered, over p phases.

    pair: the curves "lv_volume" and "rv_volume" and the observations of both; true_strain, registered_strain
    (p, 3, 16): see :func:`heartfit.observation.strain.segment_strain`; point_error (p, 2) m: mean and 95th percentile
    over the nodes of the distance between the two places; point_error_of_beat (2,) m: the same over all nodes in all
    phases after the first, where both are the mesh itself; folded (p,): inverted tetrahedra of the registered motion.
    """

    pair: Pair
    true_strain: Floats
    registered_strain: Floats
    point_error: Floats
    point_error_of_beat: Floats
    folded: Integers

    @property
    def end_systole(self) -> int:
        """The phase of the least true volume of the left ventricle."""
        return int(self.pair.true.curves["lv_volume"].values.argmin())

    def observation_errors(self) -> dict[str, float]:
        """Error of each observation, registered / true - 1: negative where its size is underestimated."""
        true, registered = self.pair.true.observations, self.pair.measured.observations
        return {name: registered[name] / value - 1.0 for name, value in true.items()}

    def strain_error_at_end_systole(self) -> Floats:
        """Registered less true strain (3, 16) at end systole."""
        difference: Floats = (self.registered_strain - self.true_strain)[self.end_systole]
        return difference

    def strain_error_of_beat(self) -> Floats:
        """Root mean square (3, 16) over the phases of registered less true strain."""
        return np.sqrt(((self.registered_strain - self.true_strain) ** 2).mean(axis=0))


def compare_motions(
    mesh: VentricularMesh,
    true: Motion,
    registered: Motion,
    features: Mapping[str, CurveFeatures],
    catheter: tuple[Curve, Curve] | None = None,
) -> Comparison:
    """Compares two motions of one mesh at the same frames.

    features: the operators of "lv_volume", and of "lv_pressure" where a catheter gave one; catheter: LV pressure in Pa
    as it was and as it was recorded. Raises InputError for motions whose nodes, frames or periods differ, and for a
    mesh without AHA segments.
    """
    _require_same_frames(mesh, true, registered)
    pressures = ({}, {}) if catheter is None else tuple({"lv_pressure": curve} for curve in catheter)
    readings = [
        Reading.of(cavity_volumes(mesh, motion) | pressure, features)
        for motion, pressure in zip((true, registered), pressures, strict=True)
    ]
    distance = np.linalg.norm(registered.positions - true.positions, axis=2)
    return Comparison(
        pair=Pair(*readings),
        true_strain=segment_strain(mesh, true),
        registered_strain=segment_strain(mesh, registered),
        point_error=np.column_stack([distance.mean(axis=1), np.percentile(distance, 95.0, axis=1)]),
        point_error_of_beat=np.array([distance[1:].mean(), np.percentile(distance[1:], 95.0)]),
        folded=inverted_elements(mesh, registered),
    )


def _require_same_frames(mesh: VentricularMesh, true: Motion, registered: Motion) -> None:
    for name, motion in (("true", true), ("registered", registered)):
        if motion.positions.shape[1] != len(mesh.points):
            raise InputError(
                f"comparison: the {name} motion has {motion.positions.shape[1]} nodes, the mesh {len(mesh.points)}; "
                "expected the same mesh: carry the motion to it"
            )
    if len(true.times) != len(registered.times):
        raise InputError(
            f"comparison: {len(true.times)} true and {len(registered.times)} registered frames; "
            "expected the same frames: take the true motion at the times of the images"
        )
    apart = max(np.abs(true.times - registered.times).max(), abs(true.period - registered.period))
    if apart > SAME_TIME:
        raise InputError(
            f"comparison: frames or periods are up to {apart:g} s apart; expected at most {SAME_TIME:g} s: "
            "take the true motion at the times of the images"
        )

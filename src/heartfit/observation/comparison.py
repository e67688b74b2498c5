"""Errors of registration on a known motion: volumes, strain, positions and folds.

A simulated motion, its synthetic images, and the motion that registration recovers from them. Both motions are taken at
the frames of the images, so the errors exclude the effect of sampling: the observation operator takes simulated curves
at the same frames.

Reference: Marchesseau et al. 2012, section 4.3.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from heartfit.core.arrays import Floats, Integers
from heartfit.core.errors import InputError
from heartfit.geometry.carry import count_inverted_elements
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.observation.curve import Curve
from heartfit.observation.noise_model import NoiseModel, Setting, StrainError
from heartfit.observation.operator import CurveFeatures, Pair, Reading
from heartfit.observation.shape import cavity_volumes
from heartfit.observation.strain import segment_strain

TIME_TOLERANCE = 1e-3
"""Largest difference of frame times and periods [s]; image headers round trigger times to it."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """One motion, true and registered, over p phases.

    pair: the curves "lv_volume" and "rv_volume" and the observations of both; true_strain, registered_strain
    (p, 3, 16): see :func:`heartfit.observation.strain.segment_strain`; point_error (p, 2): mean and 95th percentile [m]
    over the nodes of the distance between true and registered position; point_error_of_beat (2,): the same [m] over
    all nodes in all phases after the first, where both motions are the mesh itself; folded (p,): number of inverted
    tetrahedra of the registered motion.
    """

    pair: Pair
    true_strain: Floats
    registered_strain: Floats
    point_error: Floats
    point_error_of_beat: Floats
    folded: Integers

    @property
    def end_systole(self) -> int:
        """Phase of the smallest true volume of the left ventricle."""
        return int(self.pair.true.curves["lv_volume"].values.argmin())

    def observation_errors(self) -> dict[str, float]:
        """Relative error of each observation, registered / true - 1: negative where its size is underestimated."""
        true, registered = self.pair.true.observations, self.pair.measured.observations
        return {name: registered[name] / value - 1.0 for name, value in true.items()}

    def strain_error_at_end_systole(self) -> Floats:
        """Registered minus true strain (3, 16) at end systole."""
        difference: Floats = (self.registered_strain - self.true_strain)[self.end_systole]
        return difference


def learn_noise(comparisons: Sequence[Comparison], protocol: Mapping[str, Setting]) -> NoiseModel:
    """Noise model of images of one ``protocol``, from registered sequences of known truth."""
    model = NoiseModel.from_pairs([comparison.pair for comparison in comparisons], protocol)
    errors = np.array([comparison.strain_error_at_end_systole() for comparison in comparisons])
    return replace(model, strain=StrainError(errors.mean(axis=0), errors.std(axis=0, ddof=1)))


def compare_motions(
    mesh: VentricularMesh,
    true: Motion,
    registered: Motion,
    features: Mapping[str, CurveFeatures],
    catheter: tuple[Curve, Curve] | None = None,
) -> Comparison:
    """Compare two motions of one mesh at the same frames.

    features: the operators of "lv_volume", and of "lv_pressure" where a catheter recorded it; catheter: LV pressure
    [Pa], true and recorded. Raises InputError for motions whose nodes, frames or periods differ, and for a
    mesh without AHA segments.
    """
    _require_same_frames(mesh, true, registered)
    pressures = ({}, {}) if catheter is None else tuple({"lv_pressure": curve} for curve in catheter)
    readings = [
        Reading.from_curves(cavity_volumes(mesh, motion) | pressure, features)
        for motion, pressure in zip((true, registered), pressures, strict=True)
    ]
    distance = np.linalg.norm(registered.positions - true.positions, axis=2)
    return Comparison(
        pair=Pair(*readings),
        true_strain=segment_strain(mesh, true),
        registered_strain=segment_strain(mesh, registered),
        point_error=np.column_stack([distance.mean(axis=1), np.percentile(distance, 95.0, axis=1)]),
        point_error_of_beat=np.array([distance[1:].mean(), np.percentile(distance[1:], 95.0)]),
        folded=count_inverted_elements(mesh, registered),
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
    difference = max(np.abs(true.times - registered.times).max(), abs(true.period - registered.period))
    if difference > TIME_TOLERANCE:
        raise InputError(
            f"comparison: times of the frames or periods differ by up to {difference:g} s; "
            f"expected at most {TIME_TOLERANCE:g} s: take the true motion at the times of the images"
        )

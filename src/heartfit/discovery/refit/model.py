"""Three-dimensional model of a case: its simulator, its observed beats, and the reference before any fit."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.nearby_beats import NearbyBeats, points_around, simulate_each
from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.discovery.sphere_model.recentred import centred_search
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.geometry.fibres import prepare
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.heart.activation.conduction import HEALTHY, assign_activation, fit_conduction
from heartfit.heart.beat import Beat, nodal_motion
from heartfit.heart.finite_elements.kinematics import StepFailed
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.personalise.numerics import Pressures, TimeScheme
from heartfit.personalise.run import nearby_beats, run_beat
from heartfit.personalise.setting import Setting
from heartfit.places import Place

TANGENT = 0.02
"""Distance of neighbours in a tangent-linear beat [prior standard deviations]."""


@dataclass(frozen=True, eq=False)
class Model:
    """The simulator of a case: maps an extended setting and its parameters, by name [SI], to their beat."""

    mesh: VentricularMesh
    period: float
    pressures: Pressures
    scheme: TimeScheme

    def __call__(
        self, extension: Extension, parameters: Mapping[str, float], keep_positions: bool = False
    ) -> Beat:
        return run_beat(
            self.mesh,
            extension.setting,
            self.period,
            parameters,
            self.pressures,
            self.scheme,
            keep_positions=keep_positions,
        )

    def nearby(self, extension: Extension, x: Floats) -> NearbyBeats:
        """The beats at the coordinates x (d,) and around them: to first order, or one by one where that fails."""
        points = points_around(x, TANGENT)
        try:
            centre, *others = nearby_beats(
                self.mesh,
                extension.setting,
                self.period,
                [extension.parameters(point) for point in points],
                TANGENT,
                self.pressures,
                self.scheme,
            )
        except (
            InputError,
            StepFailed,
        ):  # spheres, atria in some beats only, or a step that not all beats take
            return simulate_each(self, extension, x)
        return NearbyBeats(centre, tuple(others), TANGENT, 1)


@dataclass(frozen=True, eq=False)
class ObservedBeat:
    """Observations of a completed beat: curves by name, and the wall's motion from the trigger on."""

    curves: Mapping[str, Curve]
    motion: Motion

    @classmethod
    def from_beat(cls, beat: Beat, extension: Extension, parameters: Mapping[str, float]) -> "ObservedBeat":
        """Observe a beat that kept its nodes."""
        return cls(beat_curves(beat, extension.setting.sensors(parameters)), nodal_motion(beat))


@dataclass(frozen=True, eq=False)
class Reference:
    """A model of a heart before any fit: its wall at end diastole, its setting and its numerics."""

    mesh: VentricularMesh
    setting: Setting
    pressures: Pressures
    scheme: TimeScheme

    def search(
        self, recording: Recording, places: Sequence[type[Place]] = (), left_out: Collection[str] = ()
    ) -> Diagnosis:
        """Diagnose a recording of this wall with a sphere centred on the beat at the prior mean.

        places, left_out: see :func:`heartfit.discovery.sphere_model.diagnose.diagnose`. Raises InputError where that
        beat fails.
        """
        mesh = activate(self.mesh)
        beat = run_beat(mesh, self.setting, recording.period, {}, self.pressures, self.scheme)
        if not beat.completed:
            raise InputError(f"reference beat: {beat.reason}; expected one: choose another prior or mesh")
        heart = self.setting.base_heart(recording.period)
        return centred_search(recording, heart, [beat_curves(beat)], places=places, left_out=left_out)


def activate(mesh: VentricularMesh) -> VentricularMesh:
    """The mesh with fibres, regions and the activation of a healthy conduction."""
    prepared = prepare(mesh)
    return assign_activation(prepared, fit_conduction(prepared, HEALTHY, None))

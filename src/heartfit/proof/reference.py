"""The one three-dimensional beat on which the sphere of a search is centred."""

from dataclasses import dataclass

from heartfit.configuration.generator import Pressures
from heartfit.configuration.numerics import TimeScheme
from heartfit.configuration.setting import Setting
from heartfit.diagnosis.cause import Diagnosis
from heartfit.diagnosis.recording import Recording
from heartfit.electrophysiology.conduction import HEALTHY
from heartfit.electrophysiology.onset import assign_activation
from heartfit.electrophysiology.personalise import personalised
from heartfit.errors import InputError
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.prepare import prepare
from heartfit.observation.beat import beat_curves
from heartfit.proof.centred_search import centred_search
from heartfit.protocol import run_beat


@dataclass(frozen=True, eq=False)
class Reference:
    """A model of a heart that nothing was fitted to: its wall at end diastole, the setting and how it beats."""

    mesh: VentricularMesh
    setting: Setting
    pressures: Pressures
    scheme: TimeScheme

    def search(self, recording: Recording) -> Diagnosis:
        """The diagnosis of a recording of this wall, the sphere centred on the beat at the mean of the prior.

        Raises InputError where that beat fails.
        """
        mesh = activated(self.mesh)
        beat = run_beat(mesh, self.setting, recording.period, {}, self.pressures, self.scheme)
        if not beat.completed:
            raise InputError(f"reference beat: {beat.reason}; expected one: choose another prior or mesh")
        return centred_search(recording, self.setting.base_heart(recording.period), [beat_curves(beat)])


def activated(mesh: VentricularMesh) -> VentricularMesh:
    """The mesh with fibres, regions and the activation of a healthy conduction."""
    prepared = prepare(mesh)
    return assign_activation(prepared, personalised(prepared, HEALTHY, None))

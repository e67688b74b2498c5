"""The one three-dimensional beat on which the sphere of a search is centred."""

from dataclasses import dataclass

from heartfit.configuration.generator import Pressures
from heartfit.configuration.numerics import TimeScheme
from heartfit.configuration.setting import Setting
from heartfit.diagnosis.cause import Diagnosis
from heartfit.diagnosis.diagnose import diagnose
from heartfit.diagnosis.recentred import recentred
from heartfit.diagnosis.recording import Recording
from heartfit.discovery.rules import STRICT
from heartfit.electrophysiology.conduction import HEALTHY
from heartfit.electrophysiology.onset import assign_activation
from heartfit.electrophysiology.personalise import personalised
from heartfit.errors import InputError
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.prepare import prepare
from heartfit.observation.beat import beat_curves
from heartfit.protocol import run_beat


@dataclass(frozen=True, eq=False)
class Reference:
    """A model of a heart that nothing was fitted to: its wall at end diastole, the setting and how it beats.

    The sphere is taken however well it follows the beat: about one that it followed to 0.13 kPa only, a heart without
    an effect gave an ln Bayes factor of 6, about an adult's 15. Where it does not follow, more is asked of a detection.
    """

    mesh: VentricularMesh
    setting: Setting
    pressures: Pressures
    scheme: TimeScheme

    def search(self, recording: Recording) -> Diagnosis:
        """The diagnosis of a recording of this wall, the sphere centred on the beat at the mean of the prior.

        Raises InputError where that beat fails.
        """
        prepared = prepare(self.mesh)
        mesh = assign_activation(prepared, personalised(prepared, HEALTHY, None))
        beat = run_beat(mesh, self.setting, recording.period, {}, self.pressures, self.scheme)
        if not beat.completed:
            raise InputError(f"reference beat: {beat.reason}; expected one: choose another prior or mesh")
        centre = recentred(self.setting.base_heart(recording.period), beat_curves(beat), recorded=())
        return diagnose(recording, centre=centre, rules=STRICT)

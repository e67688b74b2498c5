"""Sequences of known truth for the noise of regional strain: hearts, images and registered motions, kept on disk.

Hearts are drawn as those of the registration error are, imaged by the cohort's scanner and registered with the study's
settings. Their beat is the second one at a step of 10 ms: the noise is that of images and registration, and it does not
depend on how well the beat repeats. Some hearts have a scar or a late wall, as the hearts to be diagnosed do; sound
hearts alone would leave open how registration smears the border of a scar.
"""

import pickle
import time
from dataclasses import dataclass
from functools import cache

from benchmarks.ventricles import FOLDER, ROOT
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.imaging.registration.track import track
from heartfit.io.configuration import read_study
from heartfit.mechanisms.delayed_activation import DelayedActivation
from heartfit.mechanisms.scar import Scar
from heartfit.roles import Mechanism
from heartfit.study.study import Study
from heartfit.synthetic.cine import image_beat
from heartfit.synthetic.volunteer import Template, draw_anatomy, draw_heart, generate

SEED = 640000
"""Seed of the first heart; nothing else uses it or the hundred after it."""
SOUND = 22
"""Number of sound hearts, the first ones."""
EFFECTS: tuple[Mechanism, ...] = (
    Scar(0.2, 1.05),
    DelayedActivation(0.06),
    Scar(0.25, 3.1),
    DelayedActivation(0.09, 3.5, 0.4),
    Scar(0.2, 5.2),
    DelayedActivation(0.06, 1.5, 0.4),
)
"""Effects of the further hearts."""
STEP, BEATS = 0.01, 2
"""Time step [s] and number of beats of a heart."""


@dataclass(frozen=True, eq=False)
class Sequence:
    """A mesh at end diastole with its true and its registered motion at the frames, and the time that it took.

    effect: name of the mechanism that is hidden in the heart, empty for a sound one; cpu: [s].
    """

    number: int
    effect: str
    mesh: VentricularMesh
    true: Motion
    registered: Motion
    cpu: float


def sequence(number: int) -> Sequence:
    """Sequence of a number below SOUND + len(EFFECTS), made now if it is not on disk yet."""
    path = FOLDER / "strain_noise" / f"{number}.pickle"
    if not path.exists():
        made_now = _acquire(number)
        path.parent.mkdir(parents=True, exist_ok=True)
        unfinished = path.with_suffix(".part")
        unfinished.write_bytes(pickle.dumps(made_now))
        unfinished.rename(path)
    kept: Sequence = pickle.loads(path.read_bytes())
    return kept


def _acquire(number: int) -> Sequence:
    study, template, begin = _study(), _template(), time.process_time()
    error, seed = study.registration_error, SEED + number
    numerics = error.numerics.model_copy(update={"time_step": STEP, "max_beats": BEATS})
    protocol = error.model_copy(update={"numerics": numerics}).protocol(study.end_diastolic_pressure)
    anatomy = draw_anatomy(seed)
    heart, truth = draw_heart(study.cohort.heart, anatomy.period, seed)
    effect = EFFECTS[number - SOUND] if number >= SOUND else None
    hidden = heart if effect is None else heart + effect
    volunteer = generate(template.deformed_to(anatomy.shape), (hidden, truth), protocol)
    images = image_beat(volunteer.mesh, volunteer.motion, study.scanner(), seed)
    registered = track(images, volunteer.mesh, study.registration.free_form()).motion
    true = volunteer.motion.resample(images.times)
    name = "" if effect is None else type(effect).__name__
    return Sequence(number, name, volunteer.mesh, true, registered, time.process_time() - begin)


@cache
def _study() -> Study:
    return read_study([ROOT / "config" / "config.yaml"])


@cache
def _template() -> Template:
    size = _study().registration_error.mesh
    return Template.build(size.edge_length, size.tolerance)

"""Sequences of known truth for the noise of regional strain: hearts, images and registered motions, kept on disk.

Hearts are drawn as those of the registration error are, imaged by the cohort's scanner and registered with the study's
settings. Their beat is the second one at a step of 10 ms: the noise is that of images and registration, and it does not
depend on how well the beat repeats. Some hearts have a scar or a late wall, as the hearts to be diagnosed do; sound
hearts alone would leave open how registration smears the border of a scar.
"""

import time
from dataclasses import dataclass
from functools import cache

import numpy as np

from benchmarks.in_turn import kept_on_disk
from benchmarks.planted_ventricles import study
from benchmarks.ventricles import FOLDER, ROOT
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.imaging.registration.track import track
from heartfit.io.templates import TEMPLATES, find_template
from heartfit.mechanisms.delayed_activation import DelayedActivation
from heartfit.mechanisms.scar import Scar
from heartfit.roles import Mechanism
from heartfit.synthetic.cine import image_beat
from heartfit.synthetic.volunteer import Template, draw_anatomy, draw_heart, generate

SEED = 640000
"""Seed of the first heart; nothing else uses it or the hundred after it."""
SOUND, AFFECTED = 24, 24
"""Numbers of sound hearts, the first ones, and of hearts with an effect, by turns a scar and a late wall."""
EXTENTS, LATENESSES, SHARES = (0.1, 0.3), (0.03, 0.1), (0.3, 0.6)
"""Ranges of the extent of a scar [1], and of the lateness [s] and the share [1] of a late wall."""
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
    """Sequence of a number below SOUND + AFFECTED, made now if it is not on disk yet."""
    return kept_on_disk(FOLDER / "strain_noise" / f"{number}.pickle", lambda: _acquire(number))


def _acquire(number: int) -> Sequence:
    template, begin = _template(), time.process_time()
    error, seed = study().registration_error, SEED + number
    numerics = error.numerics.model_copy(update={"time_step": STEP, "max_beats": BEATS})
    protocol = error.model_copy(update={"numerics": numerics}).protocol(study().end_diastolic_pressure)
    anatomy = draw_anatomy(seed)
    heart, truth = draw_heart(study().cohort.heart, anatomy.period, seed)
    effect = _effect(number)
    hidden = heart if effect is None else heart + effect
    volunteer = generate(template.deformed_to(anatomy.shape), (hidden, truth), protocol)
    images = image_beat(volunteer.mesh, volunteer.motion, study().scanner(), seed)
    registered = track(images, volunteer.mesh, study().registration.free_form()).motion
    true = volunteer.motion.resample(images.times)
    name = "" if effect is None else type(effect).__name__
    return Sequence(number, name, volunteer.mesh, true, registered, time.process_time() - begin)


def _effect(number: int) -> Mechanism | None:
    """Draw the effect of a heart, anywhere around the ventricle; a sound heart has none."""
    rng = np.random.default_rng([SEED, number])
    angle = float(rng.uniform(0.0, 2.0 * np.pi))
    if number < SOUND:
        return None
    if number % 2 == 0:
        return Scar(float(rng.uniform(*EXTENTS)), angle)
    return DelayedActivation(float(rng.uniform(*LATENESSES)), angle, float(rng.uniform(*SHARES)))


@cache
def _template() -> Template:
    return find_template(study().registration_error.mesh, ROOT / TEMPLATES)

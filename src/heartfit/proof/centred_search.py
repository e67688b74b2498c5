"""The search for a case's cause, on a sphere centred on its own three-dimensional beat where one can follow it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from heartfit.diagnosis.cause import Diagnosis
from heartfit.diagnosis.centre import Centre
from heartfit.diagnosis.diagnose import diagnose
from heartfit.diagnosis.recentred import recentred
from heartfit.diagnosis.recording import Recording
from heartfit.diagnosis.self_test import LARGEST, self_test
from heartfit.discovery.rules import CENTRED, STRICT, Rules
from heartfit.errors import InputError
from heartfit.heart import Heart
from heartfit.observation.curve import Curve


def centred_search(recording: Recording, heart: Heart, beats: Sequence[Mapping[str, Curve]]) -> Diagnosis:
    """The diagnosis of a recording, the sphere centred on the first of the ``beats``, which is the ``heart``'s.

    The others are of the same model at other parameters: a sphere that finds effects in them fails its self-test, and
    the threshold of a detection is raised. So it is where the sphere does not follow the first beat well: about one
    that it followed to 0.13 kPa only, a heart without an effect gave an ln Bayes factor of 6, about an adult's sphere
    15. Beats without curves failed; without a sphere that beats like the first the adult's is left.
    """
    first, *others = beats
    for followed, rules in ((recording.searched, CENTRED), ((), STRICT)):
        try:
            centre = recentred(heart, first, followed)
        except InputError:
            continue
        return _tested(recording, centre, [each for each in others if each], rules)
    return diagnose(recording, rules=STRICT)


def _tested(
    recording: Recording, centre: Centre, sound: Sequence[Mapping[str, Curve]], rules: Rules
) -> Diagnosis:
    found = self_test(recording, centre, sound) if sound else None
    asked = rules if found is None or found <= LARGEST else STRICT
    return replace(diagnose(recording, centre=centre, rules=asked), self_test=found)

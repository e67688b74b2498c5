"""The search for a case's cause, on a sphere centred on its own three-dimensional beat where one can follow it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from heartfit.diagnosis.cause import Diagnosis
from heartfit.diagnosis.diagnose import diagnose
from heartfit.diagnosis.recentred import recentred
from heartfit.diagnosis.recording import Recording
from heartfit.diagnosis.self_test import LARGEST, self_test
from heartfit.discovery.rules import CENTRED, STRICT
from heartfit.errors import InputError
from heartfit.heart import Heart
from heartfit.observation.curve import Curve


def centred_search(recording: Recording, heart: Heart, beats: Sequence[Mapping[str, Curve]]) -> Diagnosis:
    """The diagnosis of a recording, the sphere centred on the first of the ``beats``, which is the ``heart``'s.

    The others are of the same model at other parameters: a sphere that finds effects in them fails its self-test, and
    the threshold of a detection is raised. So it is where the sphere cannot follow the first beat, and stays that of
    any adult. Beats without curves failed.
    """
    first, *others = beats
    try:
        centre = recentred(heart, first, recording.searched)
    except InputError:
        return diagnose(recording, rules=STRICT)
    sound = [each for each in others if each]
    tested = self_test(recording, centre, sound) if sound else None
    rules = STRICT if tested is not None and tested > LARGEST else CENTRED
    return replace(diagnose(recording, centre=centre, rules=rules), self_test=tested)

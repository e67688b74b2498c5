"""The search for a case's cause, on a sphere centred on its own three-dimensional beat where one can follow it."""

from collections.abc import Mapping

from heartfit.diagnosis.cause import Diagnosis
from heartfit.diagnosis.diagnose import diagnose
from heartfit.diagnosis.recentred import recentred
from heartfit.diagnosis.recording import Recording
from heartfit.discovery.rules import RULES, STRICT
from heartfit.errors import InputError
from heartfit.heart import Heart
from heartfit.observation.curve import Curve


def centred_search(recording: Recording, heart: Heart, beat: Mapping[str, Curve]) -> Diagnosis:
    """The diagnosis of a recording, the sphere centred on a ``beat`` of the ``heart``.

    Where the sphere cannot follow that beat it stays that of any adult, and the threshold of a detection is raised.
    """
    try:
        centre = recentred(heart, beat, recording.searched)
    except InputError:
        return diagnose(recording, rules=STRICT)
    return diagnose(recording, centre=centre, rules=RULES)

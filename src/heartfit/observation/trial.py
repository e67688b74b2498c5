"""One trial of the measurement: a beat that is known, imaged, registered and compared with what was found."""

from collections.abc import Mapping

from heartfit.beat import Beat
from heartfit.cohort.catheter import Catheter
from heartfit.cohort.cine import image_beat
from heartfit.cohort.scanner import Scanner
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.observation.beat import beat_curves
from heartfit.observation.comparison import Comparison, compare_motions
from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures
from heartfit.registration.track import FreeForm, track


def try_acquisition(
    mesh: VentricularMesh,
    motion: Motion,
    beat: Beat,
    scanner: Scanner,
    registration: FreeForm,
    catheter: Catheter,
    features: Mapping[str, CurveFeatures],
    seed: int,
) -> Comparison:
    """What scanner, registration and catheter make of a beat; mesh: at end diastole; motion: of its nodes.

    features: the operators of "lv_volume" and "lv_pressure".

    The registered mesh is the one that moved, so that the comparison tells what images and registration cost, and
    nothing of what another mesh of the same wall would.
    """
    images = image_beat(mesh, motion, scanner, seed)
    registered = track(images, mesh, registration).motion
    pressure = beat_curves(beat)["lv_pressure"]
    recorded = Curve.of_pressure(*catheter.record(beat, seed))
    return compare_motions(mesh, motion.sampled(images.times), registered, features, (pressure, recorded))

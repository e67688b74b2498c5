r"""A hidden beat as images show it: frames of a scanner, and a mesh that registration carries through them.

What errs in the images errs before the scanner, node by node:

.. math:: x'_n(t) = (S x_n)(t), \qquad V_i = V(\text{the mesh that follows the images of } x'(t_i))

with S the sensors of the heart that act on a volume: frames that are labelled late, of another rate, or smeared.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import reduce

import numpy as np

from heartfit.cohort.cine import image_beat
from heartfit.cohort.generate import Volunteer
from heartfit.cohort.scanner import Scanner
from heartfit.cohort.template import Template
from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.mechanism import Sensor
from heartfit.observation.curve import Curve
from heartfit.observation.volumes import cavity_volumes
from heartfit.registration.track import FreeForm, track

VOLUME = "lv_volume"


@dataclass(frozen=True, eq=False)
class Seen:
    """The diagnoser's mesh in the first frame, the left volume that it shows in all of them, and how far that errs.

    error: root mean square over the largest volume.
    """

    mesh: VentricularMesh
    volume: Curve
    error: float


@dataclass(frozen=True, eq=False)
class Imaging:
    """Scanner, registration, and the template of the mesh that is carried; hidden: the template of the one imaged."""

    scanner: Scanner
    registration: FreeForm
    template: Template
    hidden: VentricularMesh

    def seen(self, volunteer: Volunteer, sensors: Sequence[Sensor], frames: int, seed: int) -> Seen:
        """What so many frames of a beat show; raises InputError where registration folds the wall."""
        motion = distorted(volunteer.motion, sensors)
        outline = volunteer.mesh.with_points(motion.at(0.0))
        images = image_beat(outline, motion, replace(self.scanner, frames=frames), seed)
        mesh = self.template.refilling(outline, self.hidden)
        volume = cavity_volumes(mesh, track(images, mesh, self.registration).motion)[VOLUME]
        true = cavity_volumes(outline, motion.sampled(images.times))[VOLUME]
        error = np.sqrt(np.mean((volume.values - true.values) ** 2)) / true.values.max()
        return Seen(mesh, volume, float(error))


def distorted(motion: Motion, sensors: Sequence[Sensor]) -> Motion:
    """The motion that the images show of another."""
    acting = [each for each in sensors if VOLUME in each.measures]

    def shown(path: Floats) -> Floats:
        return reduce(lambda seen, each: each.distort(motion.times, seen, motion.period), acting, path)

    return replace(motion, positions=np.apply_along_axis(shown, 0, motion.positions)) if acting else motion

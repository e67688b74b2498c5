r"""Effects hidden in three dimensions: ventricles whose mesh, time step, valves and parameters differ from the model's.

The hidden beat is that of the virtual cohort, and its parameters scatter like those of the hidden spheres; size and
rate follow from the anatomy, which is also drawn. The volume is that of a mesh registered through the frames of a
scanner; the pressure has the errors of the hidden spheres. Sensors of the heart distort the node paths before imaging:

.. math:: x'_n(t) = (S x_n)(t), \qquad V_i = V(\text{registered mesh of the images of } x'(t_i))

with S the composition of all sensors that act on a volume: late frame labels, a wrong rate, or smearing.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.heart.finite_elements.body import StepFailed
from heartfit.heart.heart import Heart
from heartfit.imaging.registration.track import FreeForm, track
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.observation.shape import cavity_volumes
from heartfit.personalise.numerics import Protocol
from heartfit.roles import Sensor
from heartfit.roles.sides import right_excess
from heartfit.synthetic.balance import balancing_value
from heartfit.synthetic.campaign import Inadmissible, PlantedPlan, effects_of
from heartfit.synthetic.case import (
    REST,
    Answer,
    PlantedCase,
    draw_admissible,
    draw_effects,
    require_plausible,
    require_plausible_right,
    require_recordable,
)
from heartfit.synthetic.cine import image_beat
from heartfit.synthetic.hidden import (
    RELATIVE,
    TIMES,
    Normal,
    RecordingProtocol,
    record_pressure,
    scatter_parameters,
)
from heartfit.synthetic.out_of_library import add_effect
from heartfit.synthetic.scanner import Scanner
from heartfit.synthetic.volunteer import (
    OTHER_MODEL,
    VALVES,
    Template,
    Volunteer,
    VolunteerError,
    draw_anatomy,
    generate,
)

VOLUME = "lv_volume"


@dataclass(frozen=True, eq=False)
class ImagedBeat:
    """Imaged beat: the diagnoser's mesh in the first frame, and its registered motion.

    error: root mean square error of the left volume over the largest volume.
    """

    mesh: VentricularMesh
    motion: Motion
    error: float

    @property
    def volumes(self) -> dict[str, Curve]:
        """Volumes of both ventricles [m^3] of the registered mesh, by name."""
        return cavity_volumes(self.mesh, self.motion)


@dataclass(frozen=True, eq=False)
class Imaging:
    """Scanner, registration, and template of the registered mesh; hidden: template of the imaged mesh."""

    scanner: Scanner
    registration: FreeForm
    template: Template
    hidden: VentricularMesh

    def image(self, volunteer: Volunteer, sensors: Sequence[Sensor], frames: int, seed: int) -> ImagedBeat:
        """Image ``frames`` frames of a beat and register them; raise InputError if registration folds the wall."""
        motion = distort_motion(volunteer.motion, sensors)
        outline = volunteer.mesh.with_points(motion.at(0.0))
        images = image_beat(outline, motion, replace(self.scanner, frames=frames), seed)
        mesh = self.template.fill_wall_of(outline, self.hidden)
        registered = track(images, mesh, self.registration).motion
        volume = cavity_volumes(mesh, registered)[VOLUME]
        true = cavity_volumes(outline, motion.resample(images.times))[VOLUME]
        error = np.sqrt(np.mean((volume.values - true.values) ** 2)) / true.values.max()
        return ImagedBeat(mesh, registered, float(error))


def distort_motion(motion: Motion, sensors: Sequence[Sensor]) -> Motion:
    """Apply the sensors of the volume to every node path; return the motion that the images show."""
    acting = [sensor for sensor in sensors if VOLUME in sensor.measures]

    def distort(path: Floats) -> Floats:
        return reduce(
            lambda values, sensor: sensor.distort(motion.times, values, motion.period), acting, path
        )

    return replace(motion, positions=np.apply_along_axis(distort, 0, motion.positions)) if acting else motion


LEFT_ATRIUM, RIGHT_ATRIUM = "circulation.left_atrium", "circulation.right_atrium"
PRESSURE_RATIO, PRESSURE_TOLERANCE = 1.5, 5.0
"""Ratio of right atrial pressures between which the balance is sought, and their tolerance [Pa], 0.4 mL of a stroke."""
MOVED_TOLERANCE = 1.0
"""The same where the left pressure, which is several times as high, changes by the inverse ratio."""
DEVIATES = (*RELATIVE, *TIMES, "mitral resistance")


@dataclass(frozen=True, eq=False)
class Ventricles:
    """Planter of cases in 3-D: template of the hidden meshes, nominal parameters, numerical protocol and imaging.

    balanced: both sides pump the same volume, in the sound heart by its right atrial pressure, with hidden effects by
    blood that moves from one atrium to the other. A search that sees both sides takes a heart without balance for one
    with a leak.
    """

    template: Template
    standard: Mapping[str, float]
    protocol: Protocol
    imaging: Imaging
    balanced: bool = False

    def plant(self, plan: PlantedPlan) -> tuple[ImagedBeat, PlantedCase]:
        """Return the imaged beat on the diagnoser's mesh, and the case; implausible draws are repeated."""
        return draw_admissible(plan.seed, lambda rng, rejected: self._draw_case(plan, rng, rejected))

    def _draw_case(
        self, plan: PlantedPlan, rng: np.random.Generator, rejected: Mapping[str, int]
    ) -> tuple[ImagedBeat, PlantedCase]:
        anatomy, normal, protocol = (
            draw_anatomy(int(rng.integers(2**31))),
            Normal(rng),
            RecordingProtocol.draw(rng),
        )
        deviates = {name: normal() for name in DEVIATES}
        heart = scatter_parameters(self._average_heart(anatomy.period), deviates, normal)
        effects = draw_effects(plan, rng, sides=2)
        wall = self.template.deformed_to(anatomy.shape)
        if self.balanced:
            heart = self._balance(wall, heart, _with_right_pressure, PRESSURE_TOLERANCE)
        for effect in effects:
            heart = add_effect(heart, effect)
        if self.balanced and effects:
            heart = self._balance(wall, heart, _with_moved_blood, MOVED_TOLERANCE)
        volunteer = self._simulate(wall, heart)
        if self.balanced:
            require_plausible_right(volunteer.beat)
        imaged = self._image(volunteer, heart, protocol.frames, int(rng.integers(2**31)))
        pressure = record_pressure(beat_curves(volunteer.beat, heart.sensors)["lv_pressure"], rng)
        curves = {REST: {VOLUME: imaged.volumes[VOLUME], "lv_pressure": pressure}}
        require_recordable(curves)
        planted = effects_of(effects, plan.scales)
        answer = Answer(plan.seed, plan.kind, planted, dict(rejected), deviates, imaged.error)
        return imaged, PlantedCase(curves, answer)

    def _average_heart(self, period: float) -> Heart:
        """Return the nominal heart of this period [s]."""
        return Heart(circulation=VALVES, period=period).with_parameters({**self.standard, **OTHER_MODEL})

    def _balance(
        self,
        wall: VentricularMesh,
        heart: Heart,
        filled: Callable[[Heart, float], Heart],
        tolerance: float,
    ) -> Heart:
        """Return the heart filled by the right atrial pressure at which both sides pump the same volume."""

        def excess(pressure: float) -> float:
            beat = self._simulate(wall, filled(heart, pressure)).beat
            return right_excess(beat.flow, heart.mechanisms) * beat.period

        start = float(heart.parameters()[RIGHT_ATRIUM])
        return filled(heart, balancing_value(excess, start, PRESSURE_RATIO, tolerance))

    def _simulate(self, wall: VentricularMesh, heart: Heart) -> Volunteer:
        try:
            volunteer = generate(wall, (heart, {}), self.protocol)
        except (VolunteerError, StepFailed):
            raise Inadmissible("no beat") from None
        require_plausible(volunteer.beat, self.protocol.numerics.drift)
        return volunteer

    def _image(self, volunteer: Volunteer, heart: Heart, frames: int, seed: int) -> ImagedBeat:
        try:
            return self.imaging.image(volunteer, heart.sensors, frames, seed)
        except InputError:
            raise Inadmissible("not followed by registration") from None


def _with_right_pressure(heart: Heart, pressure: float) -> Heart:
    return heart.with_parameters({RIGHT_ATRIUM: pressure})


def _with_moved_blood(heart: Heart, pressure: float) -> Heart:
    """Heart with this right atrial pressure [Pa], the left one changed by the inverse ratio."""
    before = heart.parameters()
    ratio = pressure / before[RIGHT_ATRIUM]
    return heart.with_parameters({RIGHT_ATRIUM: pressure, LEFT_ATRIUM: before[LEFT_ATRIUM] / ratio})

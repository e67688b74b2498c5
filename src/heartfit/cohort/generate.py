"""From a volunteer's shape and seed to the beat that a scanner images, and the truth, kept apart."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from heartfit.beat import Beat, motion_of
from heartfit.cohort.draw_shape import draw_anatomy
from heartfit.cohort.hidden_heart import draw_heart
from heartfit.cohort.protocol import Protocol as Protocol
from heartfit.cohort.template import Template
from heartfit.electrophysiology.conduction import HEALTHY, Conduction
from heartfit.electrophysiology.onset import assign_activation
from heartfit.electrophysiology.personalise import personalised
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.geometry.prepare import prepare
from heartfit.heart import Heart
from heartfit.mechanics.body import FiniteElementBody
from heartfit.mechanics.unloading import unload
from heartfit.simulation import simulate


@dataclass(frozen=True, eq=False)
class Volunteer:
    """The wall at end diastole, at the trigger, its beat, and the truth that only the evaluation may see."""

    mesh: VentricularMesh
    beat: Beat
    truth: dict[str, float]

    @property
    def motion(self) -> Motion:
        """The wall at every step of the beat."""
        return motion_of(self.beat)


class VolunteerError(RuntimeError):
    """The hidden heart did not beat: choose another seed or shape."""


def generate(
    bare: VentricularMesh,
    hidden: tuple[Heart, dict[str, float]],
    protocol: Protocol,
    conduction: Conduction = HEALTHY,
    qrs: float | None = None,
) -> Volunteer:
    """The volunteer of this wall in whom the ``hidden`` heart beats; with it comes the truth.

    qrs: s, how long the activation takes, where it was measured.
    """
    heart, truth = hidden
    prepared = prepare(bare)
    mesh = assign_activation(prepared, personalised(prepared, conduction, qrs))
    reference = unload(mesh, heart.muscle, np.array(protocol.end_diastolic_pressure))
    body = FiniteElementBody(reference, heart.muscle)
    beat = simulate(heart, body, replace(protocol.numerics, keep_positions=True))
    if not beat.completed:
        raise VolunteerError(f"the hidden heart did not beat: {beat.reason}; choose another seed or shape")
    return Volunteer(prepare(bare.with_points(motion_of(beat).at(0.0))), beat, truth)


def draw_volunteer(
    template: Template, standard: Mapping[str, float], seed: int, protocol: Protocol
) -> Volunteer:
    """A volunteer whose shape, period and heart are drawn."""
    anatomy = draw_anatomy(seed)
    hidden = draw_heart(standard, anatomy.period, seed)
    return generate(template.shaped(anatomy.shape), hidden, protocol)

"""Effects hidden in three dimensions: ventricles whose mesh, time step, valves and parameters are not the calibrator's.

The beat is the cohort's and its parameters scatter as those of the hidden spheres; size and rate come from the anatomy,
which is drawn too. The volume is that of a mesh carried through images; the pressure has the errors of the spheres'.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.cohort.draw_shape import draw_anatomy
from heartfit.cohort.generate import Volunteer, VolunteerError, generate
from heartfit.cohort.hidden_heart import OTHER_MODEL, VALVES
from heartfit.cohort.protocol import Protocol
from heartfit.cohort.template import Template
from heartfit.errors import InputError
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart import Heart
from heartfit.mechanics.body import StepFailed
from heartfit.observation.beat import beat_curves
from heartfit.planting.campaign import Plan
from heartfit.planting.case import (
    REST,
    Answer,
    PlantedCase,
    drawn_effects,
    plausible,
    redrawn,
    require_recordable,
)
from heartfit.planting.effects import Inadmissible, described
from heartfit.planting.hidden import RELATIVE, TIMES, Normal, deviating
from heartfit.planting.imaging import Imaging, Seen
from heartfit.planting.measuring import Study, recorded_pressure
from heartfit.planting.outsiders import joined

DEVIATES = (*RELATIVE, *TIMES, "mitral resistance")


@dataclass(frozen=True, eq=False)
class Ventricles:
    """How such hearts are made and imaged: the mesh that is moved to each, about which values they scatter."""

    template: Template
    standard: Mapping[str, float]
    protocol: Protocol
    imaging: Imaging

    def plant(self, plan: Plan) -> tuple[VentricularMesh, PlantedCase]:
        """The diagnoser's mesh of the first frame, and the case; draws that no patient resembles are drawn anew."""
        return redrawn(plan.seed, lambda rng, rejected: self._planted(plan, rng, rejected))

    def _planted(
        self, plan: Plan, rng: np.random.Generator, rejected: Mapping[str, int]
    ) -> tuple[VentricularMesh, PlantedCase]:
        anatomy, normal, study = draw_anatomy(int(rng.integers(2**31))), Normal(rng), Study.draw(rng)
        deviates = {name: normal() for name in DEVIATES}
        heart = deviating(self._average(anatomy.period), deviates, normal)
        effects = drawn_effects(plan, rng)
        for effect in effects:
            heart = joined(heart, effect)
        volunteer = self._beating(self.template.shaped(anatomy.shape), heart)
        seen = self._imaged(volunteer, heart, study.frames, int(rng.integers(2**31)))
        pressure = recorded_pressure(beat_curves(volunteer.beat, heart.sensors)["lv_pressure"], rng)
        curves = {REST: {"lv_volume": seen.volume, "lv_pressure": pressure}}
        require_recordable(curves)
        planted = described(effects, plan.scales)
        answer = Answer(plan.seed, plan.kind, planted, dict(rejected), deviates, seen.error)
        return seen.mesh, PlantedCase(curves, answer)

    def _average(self, period: float) -> Heart:
        """The heart about which those of this period, s, scatter."""
        return Heart(circulation=VALVES, period=period).with_parameters({**self.standard, **OTHER_MODEL})

    def _beating(self, wall: VentricularMesh, heart: Heart) -> Volunteer:
        try:
            volunteer = generate(wall, (heart, {}), self.protocol)
        except (VolunteerError, StepFailed):
            raise Inadmissible("no beat") from None
        plausible(volunteer.beat, self.protocol.numerics.drift)
        return volunteer

    def _imaged(self, volunteer: Volunteer, heart: Heart, frames: int, seed: int) -> Seen:
        try:
            return self.imaging.seen(volunteer, heart.sensors, frames, seed)
        except InputError:
            raise Inadmissible("not followed by registration") from None

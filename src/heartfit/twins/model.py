"""The calibrator's model with a sphere for its left ventricle: a run takes some milliseconds."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.calibration.forward import Outcome
from heartfit.geometry.arrays import Floats
from heartfit.heart import Heart
from heartfit.mechanics.passive.law import isotropic
from heartfit.mechanics.sphere import Sphere
from heartfit.observation.beat import observe_beats
from heartfit.observation.operator import CurveFeatures
from heartfit.simulation import Numerics
from heartfit.sphere.simulation import simulate_spheres


@dataclass(frozen=True)
class SphericalModel:
    """A heart whose left ventricle had the volumes ``cavity`` and ``wall``, m^3, under ``pressure``, Pa.

    ``features``: what is observed of a beat. Called with the parameters of some simulations it gives their outcomes.
    """

    heart: Heart
    cavity: float
    wall: float
    pressure: float
    features: Mapping[str, CurveFeatures]
    numerics: Numerics

    def __call__(self, parameters: Sequence[Mapping[str, float]]) -> list[Outcome]:
        return [self.observed(self.heart.with_parameters(each)) for each in parameters]

    def observed(self, heart: Heart) -> Outcome:
        """What is observed of another heart in a ventricle of this shape, or why it does not beat."""
        passive = isotropic(heart.muscle.passive)
        try:
            sphere = Sphere.unloaded(self.cavity, self.wall, self.pressure, passive)
        except ValueError:
            return "no stress-free sphere has this volume under this pressure"
        return observe_beats([simulate_spheres(heart, [sphere], self.numerics)], self.features)[0]

    def slopes(self, names: Sequence[str], observations: Sequence[str], step: float) -> Floats:
        """dZ/dln p (k, m) at the standard values, by central differences over +- step of the logarithms."""
        values = self.heart.parameters()
        at = {name: values[self.heart.path_of(name)] for name in names}
        up, down = (
            self([{name: value * float(np.exp(sign * step))} for name, value in at.items()])
            for sign in (1.0, -1.0)
        )
        return (_rows(up, observations) - _rows(down, observations)) / (2.0 * step)


def _rows(outcomes: Sequence[Outcome], names: Sequence[str]) -> Floats:
    failed = [outcome for outcome in outcomes if isinstance(outcome, str)]
    if failed:
        raise ValueError(f"sphere: {failed[0]}; expected a beat on either side of the standard values")
    rows = [[outcome[name] for name in names] for outcome in outcomes if not isinstance(outcome, str)]
    return np.array(rows).reshape(len(outcomes), len(names))

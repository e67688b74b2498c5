"""Mechanisms as hypotheses about a measured wall, and the starts of their fits."""

from collections.abc import Collection

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.forward_model import Candidate
from heartfit.discovery.wall_model.forward_model import WallForwardModel
from heartfit.roles import Availability, Delay, Mechanism, Narrowing, Sensor, registered
from heartfit.roles.sides import VALVES

AROUND = 6
"""Number of angles around the ventricle at which a regional effect is tried."""
ANGLE = "angle"
"""Name of the parameter of a regional effect that places it around the ventricle [rad]."""


def candidates(model: WallForwardModel, pressure: bool) -> list[Candidate]:
    """Mechanisms that the nominal heart lacks, by name; without a pressure only those that images alone can name.

    These are effects of a region of the wall and errors of the images; any other effect looks like an unusual heart.
    A narrowed valve of the right side needs a right pressure: in a volume alone the law of a sound valve looks like it.
    """
    present = {type(mechanism) for mechanism in model.nominal.heart.mechanisms}
    measured = {name for name in model.times if name.endswith(("_volume", "_pressure"))}
    kinds = [kind for _, kind in sorted(registered().items()) if kind not in present and kind.switch().scale]
    return [Candidate.from_mechanism(kind) for kind in kinds if _is_shown(kind, measured, pressure)]


def _is_shown(kind: type[Mechanism], measured: Collection[str], pressure: bool) -> bool:
    """True for a mechanism that the measured curves can tell from an unusual heart."""
    if issubclass(kind, Sensor):
        return not set(kind.measures).isdisjoint(measured)
    if issubclass(kind, Narrowing) and "rv" in VALVES[kind.valve]:
        return "rv_pressure" in measured
    return pressure or is_regional(kind)


def is_regional(kind: type) -> bool:
    """True for an effect that acts in a region of the wall, and shows in its strain."""
    return issubclass(kind, Availability | Delay)


def placements(effect: Candidate) -> list[Floats]:
    """Coordinates (k,) of the effect's unknowns at which its fits start, the amplitude being zero.

    A regional effect is tried all around the ventricle: strain of one side does not lead to the other.
    """
    names = [unknown.name for unknown in effect.unknowns]
    start = np.zeros(len(names))
    if ANGLE not in names:
        return [start]
    place = names.index(ANGLE)
    unknown = effect.unknowns[place]
    middle, reach = unknown.at(0.0), unknown.at(1.0) - unknown.at(0.0)
    turns = np.angle(np.exp(1j * (2.0 * np.pi * np.arange(AROUND) / AROUND + np.pi / 3.0 - middle)))
    return [np.where(np.arange(len(names)) == place, turn / reach, 0.0) for turn in turns]

"""The septum against the lateral wall: how they move towards each other, and when they shorten.

In left bundle branch block the septum is activated first and moves into a left ventricle that does not yet resist: the
septal flash, over before ejection begins, while the lateral wall is stretched.

References
----------
Remme EW et al. 2016, Factors determining the magnitude of the pre-ejection leftward septal motion in left bundle branch
block, Europace 18, 1905: what makes the flash large or small.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.observation.strain import DIRECTIONS, regional_strain
from heartfit.observation.volumes import cavity_volumes

SEPTAL, LATERAL = (8, 9), (11, 12)
"""AHA segments at mid-height."""

MIDDLE = (0.35, 0.70)
"""Range of the longitudinal coordinate that is mid-height."""

HALF_WIDTH = np.pi / 4
"""Of the septal and of the lateral wall, rad around the long axis."""

LEAD = 0.15
"""How long before the trigger a beat is looked at, s: the septum may move before it."""

EARLY, HALF = 0.25, 0.5
"""Shares of the stroke volume: when the first has left, a flash is over, and when the second has, its rebound."""

STOP = 0.1
"""Share of its greatest early speed below which the septum has stopped."""


@dataclass(frozen=True, eq=False)
class Walls:
    """Curves (p,) over one beat, in time, at even steps.

    times s after the trigger; septal, lateral: mean motion of the endocardium towards the opposite wall since phase 0,
    m; septal_strain, lateral_strain: circumferential; cavity: volume of the left ventricle, m^3.
    """

    times: Floats
    septal: Floats
    lateral: Floats
    septal_strain: Floats
    lateral_strain: Floats
    cavity: Floats

    def from_before_the_trigger(self) -> "Walls":
        """The same beat, begun LEAD before the trigger."""
        period = len(self.times) * np.diff(self.times).mean()
        times = np.mod(self.times + LEAD, period) - LEAD
        order = np.argsort(times)
        rest = (self.septal, self.lateral, self.septal_strain, self.lateral_strain, self.cavity)
        return Walls(times[order], *(curve[order] for curve in rest))


@dataclass(frozen=True)
class Flash:
    """A septal flash: start and end, s after the trigger; size and the way back afterwards, m."""

    start: float
    end: float
    size: float
    rebound: float


def walls_of(mesh: VentricularMesh, motion: Motion) -> Walls:
    """How the walls of a prepared mesh move; phase 0 of the motion is the reference."""
    start = mesh.with_points(motion.positions[0])
    axes = LeftVentricularAxes.of(start)
    strain = regional_strain(mesh, motion, (SEPTAL, LATERAL))[:, DIRECTIONS.index("circumferential")]
    return Walls(
        times=motion.times,
        septal=_displacement(start, motion, axes, 0.0) @ -axes.septal,
        lateral=_displacement(start, motion, axes, np.pi) @ axes.septal,
        septal_strain=strain[:, 0],
        lateral_strain=strain[:, 1],
        cavity=cavity_volumes(mesh, motion)["lv_volume"].values,
    )


def septal_flash(walls: Walls) -> Flash | None:
    """The early inward motion of the septum, from its outermost place until it stops.

    None if it goes on, without a stop, until more than EARLY of the stroke volume has left.
    """
    seen = walls.from_before_the_trigger()
    early = seen.septal[: _phase_at(seen.cavity, EARLY)]
    start = len(early) - 1 - int(early[::-1].argmin())
    speed = np.diff(seen.septal)[start : len(early)]
    fastest = int(speed.argmax())
    stops = np.flatnonzero(speed[fastest:] < STOP * speed[fastest])
    if not len(stops):
        return None
    end = start + fastest + int(stops[0])
    after = seen.septal[end : max(end + 1, _phase_at(seen.cavity, HALF))]
    rebound = (np.maximum.accumulate(after) - after).max()
    return Flash(
        float(seen.times[start]), float(seen.times[end]), float(early[end] - early[start]), float(rebound)
    )


def early_stretch(walls: Walls) -> float:
    """How far the lateral wall is stretched round the ventricle, at most, before EARLY has left; phase 0 is zero."""
    seen = walls.from_before_the_trigger()
    return float(seen.lateral_strain[: _phase_at(seen.cavity, EARLY)].max())


def delay_of_shortening(walls: Walls) -> float:
    """Time in s from the septum's greatest shortening to the lateral wall's."""
    seen = walls.from_before_the_trigger()
    return float(seen.times[seen.lateral_strain.argmin()] - seen.times[seen.septal_strain.argmin()])


def _phase_at(cavity: Floats, share: float) -> int:
    """The first phase after the fullest at which more than this share of the stroke volume has left."""
    fullest = int(cavity.argmax())
    left = cavity[fullest] - cavity[fullest:]
    return fullest + int(np.argmax(left > share * np.ptp(cavity)))


def _displacement(mesh: VentricularMesh, motion: Motion, axes: LeftVentricularAxes, middle: float) -> Floats:
    """Mean displacement (p,3) of the left endocardium at mid-height about an angle."""
    nodes = _wall(mesh, axes, middle)
    moved: Floats = (motion.positions[:, nodes] - motion.positions[0, nodes]).mean(axis=1)
    return moved


def _wall(mesh: VentricularMesh, axes: LeftVentricularAxes, middle: float) -> Integers:
    nodes = np.unique(mesh.surfaces["lv_endo"])
    height, angle = axes.longitudinal(mesh.points[nodes]), axes.angle(mesh.points[nodes]) - middle
    near = np.abs(np.angle(np.exp(1j * angle))) < HALF_WIDTH
    return nodes[near & (height > MIDDLE[0]) & (height < MIDDLE[1])]

r"""Strain of the left ventricular wall by segment, and motion of the septum against the lateral wall.

With X in phase 0 and x later, :math:`x = \sum_a x_a N_a(X)` in each tetrahedron, and a unit vector n of phase 0,

.. math:: F n = \sum_a x_a (\nabla N_a \cdot n), \qquad E_{nn} = \tfrac12 (|F n|^2 - 1)

is the Green-Lagrange strain along n. n is circumferential, longitudinal and radial in the cylinder about the long
axis, as in short-axis images. Segment 17, the apical cap, lies on the axis, where these directions are undefined; it is
left out.

In left bundle branch block the septum is activated first and moves into a left ventricle that does not yet resist: the
septal flash, over before ejection begins, while the lateral wall is stretched.

References
----------
Remme EW et al. 2016, Factors determining the magnitude of the pre-ejection leftward septal motion in left bundle branch
block, Europace 18, 1905: determinants of the size of the flash.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats, Integers
from heartfit.core.errors import InputError
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.geometry.territory import APEX
from heartfit.heart.finite_elements.kinematics import shape_gradients
from heartfit.observation.shape import cavity_volumes

DIRECTIONS = ("circumferential", "longitudinal", "radial")
SEGMENTS = np.arange(1, APEX)
"""AHA segments 1 to 16."""
SEPTAL_SEGMENTS, LATERAL_SEGMENTS = (8, 9), (11, 12)
"""AHA segments of the septal and lateral regions, at mid-height."""
MID_HEIGHT = (0.35, 0.70)
"""Range of the longitudinal coordinate that counts as mid-height [1]."""
WALL_HALF_WIDTH = np.pi / 4
"""Angular half-width of the septal and lateral regions [rad]."""
PRE_TRIGGER = 0.15
"""Time before the trigger at which a beat starts here [s], because the septum may move before the trigger."""
FLASH_END_FRACTION, REBOUND_END_FRACTION = 0.25, 0.5
"""Ejected shares of the stroke volume by which a flash and its rebound are over."""
STOP_SPEED_FRACTION = 0.1
"""Share of its largest early speed below which the septum has stopped."""


def segment_strain(mesh: VentricularMesh, motion: Motion) -> Floats:
    """Mean strain (p, 3, 16) of every phase along DIRECTIONS in SEGMENTS, weighted by the volumes of the tetrahedra.

    Phase 0 of the motion is the reference. Raises InputError for a mesh that lacks one of the segments.
    """
    return regional_strain(mesh, motion, [(int(segment),) for segment in SEGMENTS])


def regional_strain(mesh: VentricularMesh, motion: Motion, regions: Sequence[Sequence[int]]) -> Floats:
    """Mean strain (p, 3, r) as in `segment_strain`, in regions that each join some AHA segments."""
    start = mesh.with_points(motion.positions[0])
    gradients, volumes = shape_gradients(start.points, start.tets)
    weights = _region_weights(_require_segments(mesh, np.concatenate(regions)), regions, volumes)
    along = np.einsum("mad,mnd->mna", gradients, cylinder_directions(start))
    stretches = (np.einsum("mna,mad->mnd", along, positions[mesh.tets]) for positions in motion.positions)
    strain = np.array([weights @ (0.5 * ((stretch**2).sum(axis=-1) - 1.0)) for stretch in stretches])
    return strain.swapaxes(1, 2)


def cylinder_directions(mesh: VentricularMesh) -> Floats:
    """Unit vectors (m, 3, 3) of the cylinder at the centre of each tetrahedron, in the order of DIRECTIONS."""
    axes = LeftVentricularAxes.from_mesh(mesh)
    away = axes.away(mesh.points[mesh.tets].mean(axis=1))
    radial = away / np.linalg.norm(away, axis=1, keepdims=True)
    return np.stack(
        [np.cross(axes.axis, radial), np.broadcast_to(axes.axis, radial.shape), radial],
        axis=1,
    )


def _require_segments(mesh: VentricularMesh, needed: Integers) -> Integers:
    if mesh.segments is None:
        raise InputError("strain: the mesh has no AHA segments; expected a prepared mesh: build it again")
    missing = np.setdiff1d(needed, mesh.segments)
    if len(missing):
        raise InputError(
            f"strain: no tetrahedron lies in segment {', '.join(map(str, missing))}; "
            f"expected one in each of {', '.join(map(str, needed))}: take a finer mesh"
        )
    return mesh.segments


def _region_weights(segments: Integers, regions: Sequence[Sequence[int]], volumes: Floats) -> Floats:
    """Weights (r, m) of the tetrahedra in the mean over each region."""
    inside = np.array([np.isin(segments, region) for region in regions]) * volumes
    shares: Floats = inside / inside.sum(axis=1, keepdims=True)
    return shares


@dataclass(frozen=True, eq=False)
class WallMotion:
    """Motion of the septal and lateral walls: curves (p,) over one beat at equidistant, increasing times.

    times: after the trigger [s]; septal, lateral: mean motion of the endocardium towards the opposite wall since phase
    0 [m]; septal_strain, lateral_strain: circumferential [1]; cavity: volume of the left ventricle [m^3].
    """

    times: Floats
    septal: Floats
    lateral: Floats
    septal_strain: Floats
    lateral_strain: Floats
    cavity: Floats

    def starting_before_trigger(self) -> "WallMotion":
        """Return the same beat, started PRE_TRIGGER before the trigger."""
        period = len(self.times) * np.diff(self.times).mean()
        times = np.mod(self.times + PRE_TRIGGER, period) - PRE_TRIGGER
        order = np.argsort(times)
        rest = (self.septal, self.lateral, self.septal_strain, self.lateral_strain, self.cavity)
        return WallMotion(times[order], *(curve[order] for curve in rest))


@dataclass(frozen=True)
class SeptalFlash:
    """Septal flash: start and end after the trigger [s], size [m] and the rebound afterwards [m]."""

    start: float
    end: float
    size: float
    rebound: float


def wall_motion(mesh: VentricularMesh, motion: Motion) -> WallMotion:
    """Compute the motion of the walls of a prepared mesh; phase 0 of the motion is the reference."""
    start = mesh.with_points(motion.positions[0])
    axes = LeftVentricularAxes.from_mesh(start)
    strain = regional_strain(mesh, motion, (SEPTAL_SEGMENTS, LATERAL_SEGMENTS))[
        :, DIRECTIONS.index("circumferential")
    ]
    return WallMotion(
        times=motion.times,
        septal=_displacement(start, motion, axes, 0.0) @ -axes.septal,
        lateral=_displacement(start, motion, axes, np.pi) @ axes.septal,
        septal_strain=strain[:, 0],
        lateral_strain=strain[:, 1],
        cavity=cavity_volumes(mesh, motion)["lv_volume"].values,
    )


def septal_flash(walls: WallMotion) -> SeptalFlash | None:
    """Find the early inward motion of the septum, from its outermost position until it stops.

    None if it continues without a stop until more than FLASH_END_FRACTION of the stroke volume is ejected.
    """
    beat = walls.starting_before_trigger()
    early = beat.septal[: _phase_at_ejected_share(beat.cavity, FLASH_END_FRACTION)]
    start = len(early) - 1 - int(early[::-1].argmin())
    speed = np.diff(beat.septal)[start : len(early)]
    fastest = int(speed.argmax())
    stops = np.flatnonzero(speed[fastest:] < STOP_SPEED_FRACTION * speed[fastest])
    if not len(stops):
        return None
    end = start + fastest + int(stops[0])
    after = beat.septal[end : max(end + 1, _phase_at_ejected_share(beat.cavity, REBOUND_END_FRACTION))]
    rebound = (np.maximum.accumulate(after) - after).max()
    return SeptalFlash(
        float(beat.times[start]), float(beat.times[end]), float(early[end] - early[start]), float(rebound)
    )


def early_stretch(walls: WallMotion) -> float:
    """Largest circumferential strain [1] of the lateral wall until FLASH_END_FRACTION is ejected; phase 0 is zero."""
    beat = walls.starting_before_trigger()
    return float(beat.lateral_strain[: _phase_at_ejected_share(beat.cavity, FLASH_END_FRACTION)].max())


def shortening_delay(walls: WallMotion) -> float:
    """Time [s] from the largest shortening of the septum to that of the lateral wall."""
    beat = walls.starting_before_trigger()
    return float(beat.times[beat.lateral_strain.argmin()] - beat.times[beat.septal_strain.argmin()])


def _phase_at_ejected_share(cavity: Floats, share: float) -> int:
    """Return the first phase after the fullest at which more than this share of the stroke volume is ejected."""
    fullest = int(cavity.argmax())
    ejected = cavity[fullest] - cavity[fullest:]
    return fullest + int(np.argmax(ejected > share * np.ptp(cavity)))


def _displacement(mesh: VentricularMesh, motion: Motion, axes: LeftVentricularAxes, middle: float) -> Floats:
    """Mean displacement (p, 3) [m] of the left endocardium at mid-height around the angle ``middle`` [rad]."""
    nodes = _wall_nodes(mesh, axes, middle)
    displacement: Floats = (motion.positions[:, nodes] - motion.positions[0, nodes]).mean(axis=1)
    return displacement


def _wall_nodes(mesh: VentricularMesh, axes: LeftVentricularAxes, middle: float) -> Integers:
    nodes = np.unique(mesh.surfaces["lv_endo"])
    height, angle = axes.longitudinal(mesh.points[nodes]), axes.angle(mesh.points[nodes]) - middle
    near = np.abs(np.angle(np.exp(1j * angle))) < WALL_HALF_WIDTH
    return nodes[near & (height > MID_HEIGHT[0]) & (height < MID_HEIGHT[1])]

r"""Curves of regional motion: strain of the left ventricular segments, and descent of the base.

Circumferential and longitudinal Green-Lagrange strain is the mean over each of the AHA segments 1 to 16, see
:mod:`heartfit.observation.strain`. The descent of the base is the mean motion of the rims of the left endocardium, the
mitral and aortic rings, towards the apex,

.. math:: d(t) = -\frac{1}{R} \sum_r (x_r(t) - x_r(0)) \cdot a

with a the unit vector of the long axis from apex to base and R the number of nodes of the rims. Phase 0, end diastole,
is the reference of all curves, which therefore start at zero. Radial strain is left out: the wall is thin compared with
a voxel, and the right side of the septum has no clear edge.
"""

from collections.abc import Iterable

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.geometry.surface import rim_loops
from heartfit.observation.curve import Curve
from heartfit.observation.strain import DIRECTIONS, SEGMENTS, segment_strain

CIRCUMFERENTIAL, LONGITUDINAL = DIRECTIONS[:2]
BASE_DESCENT = "base_descent"
"""Name of the curve of the descent of the base [m], and of its kind."""
KINDS = (CIRCUMFERENTIAL, LONGITUDINAL, BASE_DESCENT)
"""Kinds of regional curves; the curves of a kind share one noise."""
PREFIX = "strain_"


def strain_name(direction: str, segment: int) -> str:
    """Name of the curve of strain along a direction in a segment, such as "strain_circumferential_07"."""
    return f"{PREFIX}{direction}_{segment:02d}"


def names_of_kind(kind: str) -> tuple[str, ...]:
    """Names of all curves of one of KINDS, by increasing segment; raises InputError for another kind."""
    if kind not in KINDS:
        raise InputError(f"regional curves: no kind {kind}; expected one of {', '.join(KINDS)}")
    if kind == BASE_DESCENT:
        return (BASE_DESCENT,)
    return tuple(strain_name(kind, int(segment)) for segment in SEGMENTS)


def kind_of(name: str) -> str:
    """Kind of the curve of this name; raises InputError for a name of no regional curve."""
    for kind in KINDS:
        if name in names_of_kind(kind):
            return kind
    raise InputError(
        f"regional curves: no curve {name}; expected {BASE_DESCENT} or a name such as "
        f"{strain_name(CIRCUMFERENTIAL, 7)}"
    )


def regional_curves(mesh: VentricularMesh, motion: Motion) -> dict[str, Curve]:
    """Return the strain [1] of all segments and the descent of the base [m], by name.

    mesh: with its AHA segments; motion: of its nodes, phase 0 the reference. Times are those of the motion. Raises
    InputError for a mesh that lacks a segment.
    """
    strain = segment_strain(mesh, motion)
    values = {
        name: strain[:, DIRECTIONS.index(kind), place]
        for kind in (CIRCUMFERENTIAL, LONGITUDINAL)
        for place, name in enumerate(names_of_kind(kind))
    }
    values[BASE_DESCENT] = base_descent(mesh, motion)
    return {name: Curve(motion.times, samples, motion.period) for name, samples in values.items()}


def base_descent(mesh: VentricularMesh, motion: Motion) -> Floats:
    """Mean motion (p,) [m] of the rims of the left endocardium since phase 0, positive towards the apex."""
    axis = LeftVentricularAxes.from_mesh(mesh.with_points(motion.positions[0])).axis
    rims = np.concatenate(rim_loops(mesh.surfaces["lv_endo"]))
    descent: Floats = (motion.positions[0, rims] - motion.positions[:, rims]).mean(axis=1) @ axis
    return descent


def require_common_frames(curves: Iterable[Curve]) -> None:
    """Raise InputError unless all curves have the same times."""
    first, *others = curves
    if any(other.times.shape != first.times.shape or (other.times != first.times).any() for other in others):
        raise InputError("regional curves: the times of the curves differ; expected those of one sequence")

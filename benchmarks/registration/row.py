"""Cost and errors of a registration on one sequence."""

import time
from collections.abc import Callable
from dataclasses import dataclass

from heartfit.core.errors import InputError
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.observation.comparison import compare_motions
from heartfit.observation.operator import VolumeFeatures
from heartfit.observation.shape import motion_shape

Follow = Callable[[], Motion]


@dataclass(frozen=True)
class Errors:
    """Errors of V_min, q_max and q_min, relative; of the points, mean and 95 % over the beat, m; the most
    tetrahedra that are
    folded in a frame; at end systole shortening, relative, and twist, rad, as found and as they are."""

    V_min: float
    q_max: float
    q_min: float
    mean: float
    most: float
    folded: int
    shortening: float
    twist: float
    true_shortening: float
    true_twist: float


@dataclass(frozen=True)
class Row:
    """CPU s of a frame, and the errors; or why there are none."""

    cpu: float
    errors: Errors | None
    refused: str = ""


def measured(mesh: VentricularMesh, truth: Motion, follow: Follow) -> Row:
    """The row of what ``follow`` makes of a sequence at whose frames ``truth`` stands."""
    begin = time.process_time()
    try:
        registered = follow()
    except InputError as refusal:
        return Row(_since(begin, truth), None, str(refusal))
    return Row(_since(begin, truth), errors(mesh, truth, registered))


def _since(begin: float, truth: Motion) -> float:
    return (time.process_time() - begin) / (len(truth.times) - 1)


def errors(mesh: VentricularMesh, truth: Motion, registered: Motion) -> Errors:
    """Difference between the registered motion and the true one."""
    both = compare_motions(mesh, truth, registered, {"lv_volume": VolumeFeatures(len(truth.times))})
    is_, registered_shape, end = motion_shape(mesh, truth), motion_shape(mesh, registered), both.end_systole
    return Errors(
        **both.observation_errors(),
        mean=float(both.point_error_of_beat[0]),
        most=float(both.point_error_of_beat[1]),
        folded=int(both.folded.max()),
        shortening=float(registered_shape.shortening[end]),
        twist=float(registered_shape.twist[end]),
        true_shortening=float(is_.shortening[end]),
        true_twist=float(is_.twist[end]),
    )

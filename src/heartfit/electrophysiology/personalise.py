"""The conduction that is over when the measured QRS complex is."""

from collections.abc import Callable
from dataclasses import replace

from heartfit.electrophysiology.conduction import Conduction
from heartfit.electrophysiology.onset import assign_activation
from heartfit.errors import InputError
from heartfit.geometry.mesh import VentricularMesh

LAYER, WALL = (0.4, 1.5), (0.3, 1.0)
"""Speeds, m/s, that the left endocardium without its Purkinje network may have, and the wall along its fibres."""

TOLERANCE = 5e-4
"""Of the duration, s."""

BISECTIONS = 20
"""More than the tolerance asks for in the widest range."""

Family = Callable[[float], Conduction]


def personalised(mesh: VentricularMesh, conduction: Conduction, duration: float | None) -> Conduction:
    """The conduction of which the whole of ``mesh`` is active after the measured duration, s, to half a millisecond.

    The speed of the left endocardial layer is found by bisection; where none of LAYER reaches the duration, the
    nearest is kept and the speed of the wall is found. Without a duration the conduction stays as it is.
    Raises InputError for a duration out of reach of both.
    """
    if duration is None:
        return conduction
    slowest, fastest = (replace(conduction, left_layer=speed) for speed in LAYER)
    shortest, longest = total_duration(mesh, fastest), total_duration(mesh, slowest)
    if shortest <= duration <= longest:
        return _bisected(mesh, lambda speed: replace(conduction, left_layer=speed), LAYER, duration)
    nearest = slowest if duration > longest else fastest
    _require_within_reach(mesh, replace(slowest, speed=WALL[0]), replace(fastest, speed=WALL[1]), duration)
    return _bisected(mesh, lambda speed: replace(nearest, speed=speed), WALL, duration)


def total_duration(mesh: VentricularMesh, conduction: Conduction) -> float:
    """Time in s from the earliest to the latest activation of a tetrahedron."""
    times = assign_activation(mesh, conduction).activation
    assert times is not None
    return float(times.max())


def _bisected(
    mesh: VentricularMesh, family: Family, speeds: tuple[float, float], duration: float
) -> Conduction:
    """The member whose duration is the one given: it falls with the speed, from the slower to the faster of two."""
    slow, fast = speeds
    for _ in range(BISECTIONS):
        middle = (slow * fast) ** 0.5
        excess = total_duration(mesh, family(middle)) - duration
        if abs(excess) < TOLERANCE:
            break
        slow, fast = (middle, fast) if excess > 0.0 else (slow, middle)
    return family(middle)


def _require_within_reach(mesh: VentricularMesh, slow: Conduction, fast: Conduction, duration: float) -> None:
    shortest, longest = total_duration(mesh, fast), total_duration(mesh, slow)
    if not shortest <= duration <= longest:
        raise InputError(
            f"activation: QRS of {1e3 * duration:.0f} ms; this heart can take {1e3 * shortest:.0f} to "
            f"{1e3 * longest:.0f} ms; check the duration and its unit"
        )

"""Registration of images: settings, and the order in which frames are registered."""

from collections.abc import Iterator
from dataclasses import dataclass


@dataclass(frozen=True)
class FreeForm:
    """Settings of the free-form registration.

    knots: distance of the control points [m]; stiffness: weight of the squared second derivatives of the displacement
    against the squared difference of brightness [m^2]; incompressibility: weight of the squared relative change of
    volume of the wall against it [1]; reach: distance beyond the wall up to which brightness is compared [m]; levels:
    (voxels along the side of an averaged block, largest number of steps), from coarse to fine.
    """

    knots: float = 10e-3
    stiffness: float = 4e-9
    incompressibility: float = 0.01
    reach: float = 4e-3
    levels: tuple[tuple[int, int], ...] = ((2, 10), (1, 3))


def registration_order(count: int) -> Iterator[tuple[int, int]]:
    """Yield frames after the first with a neighbour matched before: up to the middle, then back from the end."""
    middle = count // 2
    yield from ((frame, frame - 1) for frame in range(1, middle + 1))
    yield from ((frame, (frame + 1) % count) for frame in range(count - 1, middle, -1))

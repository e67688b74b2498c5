"""How frames are matched; apart from the matching, whose splines take long to import."""

from dataclasses import dataclass


@dataclass(frozen=True)
class FreeForm:
    """How frames are matched.

    knots: distance of the control points, m; stiffness: weight of the displacement's squared second derivatives beside
    the squared difference of brightness, m^2; incompressibility: weight of the wall's squared relative change of volume
    beside it; reach: how far beyond the wall brightness is compared, m; levels: blocks of how many voxels a side are
    averaged, coarse to fine, and how many steps are taken at most.
    """

    knots: float = 10e-3
    stiffness: float = 4e-9
    incompressibility: float = 0.01
    reach: float = 4e-3
    levels: tuple[tuple[int, int], ...] = ((2, 10), (1, 3))

"""Do images and end-diastolic mesh show the same heart, at the same place, the same way round?

The mesh says which voxels are wall and which are blood; a threshold (Otsu, IEEE Trans Syst Man Cybern 1979) says which
of them are dark and which are bright, as blood is in the cine images meant here. The surroundings do not count: in
front of black lung, wall would pass for bright. How well the two agree is the mean of two Dice coefficients,
2 |A and B| / (|A| + |B|), of blood with bright and of wall with dark: 1 if all voxels agree, about 1/2 if the images
know nothing of the mesh. A heart that is its own mirror image does not tell in which way it lies.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import Protocol

import numpy as np
import SimpleITK as sitk
from numpy.typing import NDArray

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.cavity import Cavity, HasSurfaces
from heartfit.imaging.grid import Grid
from heartfit.imaging.raster import paint_inside
from heartfit.imaging.sequence import ImageSequence

MARGIN = 2e-3
"""How far, m, the mesh must stay within the images."""

LEAST_DICE = 0.7
"""Below it images and mesh are not of the same heart."""

BETTER = 0.08
"""By how much another orientation must fit better before the one given is refused."""

OUTSIDE, WALL, BLOOD = 0.0, 1.0, 2.0
TOWARDS = (("right", "left"), ("front", "back"), ("feet", "head"))
"""The patient's directions along the scanner's axes x, y, z, negative and positive."""


class Wall(HasSurfaces, Protocol):
    """A mesh or a labelled surface of both ventricles."""

    @property
    def points(self) -> Floats: ...


def require_match(sequence: ImageSequence, wall: Wall, margin: float = MARGIN) -> None:
    """Raises InputError unless the first frame shows the heart of the end-diastolic mesh where the mesh is.

    The message says whether voxels run the other way along axes of the images, or the mesh's coordinates have other
    signs (as between the conventions of DICOM and NIfTI), with the Dice of both; or by how many mm the mesh is not
    covered; or that nothing fits. A negative margin lets the mesh reach out of the images, as over sparse slices.
    """
    image, grid, parts = sequence.voxels[0], sequence.grid, Parts.of(wall)
    covered = _overhang(grid, wall.points, margin).max() <= 0.0
    given = agreement(image, parts.painted(grid, wall.points)) if covered else 0.0
    others = dict(_mirrored(image, grid, parts, wall.points))
    best = max(others, key=lambda what: others[what])
    if others[best] > max(given + BETTER, LEAST_DICE):
        raise InputError(
            f"images and mesh: Dice {given:.2f} as they are, {others[best]:.2f} with {best}; "
            "correct what is the wrong way round"
        )
    require_covered(grid, wall.points, margin)
    if given < LEAST_DICE:
        raise InputError(
            f"images and mesh: Dice {given:.2f} of bright voxels with cavities and dark ones with wall, mirrored "
            f"{others[best]:.2f} at best; expected {LEAST_DICE:g}: take the images of this mesh, end diastole first"
        )


def require_covered(grid: Grid, points: Floats, margin: float = MARGIN) -> None:
    """Raises InputError unless all points (n,3), m, lie within the images' box of voxels, by the margin, m."""
    overhang = _overhang(grid, points, margin)
    if overhang.max() > 0.0:
        side, axis = np.unravel_index(int(overhang.argmax()), overhang.shape)
        end = ("first", "last")[side]
        raise InputError(
            f"images: the mesh reaches {1e3 * (overhang.max() - margin):.1f} mm beyond the {end} voxels along "
            f"{'ijk'[axis]}, {_towards(grid, int(axis), int(side))}; expected {1e3 * margin:g} mm within: "
            "take images that cover the heart"
        )


def agreement(image: Floats, painted: Floats) -> float:
    """The mean of two Dice coefficients of an image (k,j,i) with the parts of a mesh, see above; 0 if it has none."""
    wall, blood = painted == WALL, painted == BLOOD
    heart = wall | blood
    if not (wall.any() and blood.any()):
        return 0.0
    bright = image[heart] > _threshold(image[heart])
    return 0.5 * (_dice(blood[heart], bright) + _dice(wall[heart], ~bright))


@dataclass(frozen=True, eq=False)
class Parts:
    """The closed surfaces about the wall and about each cavity."""

    wall: Integers
    cavities: tuple[Cavity, ...]

    @classmethod
    def of(cls, wall: HasSurfaces) -> "Parts":
        cavities = tuple(Cavity.of(wall, name) for name in ("lv_endo", "rv_endo"))
        return cls(np.vstack(list(wall.surfaces.values())), cavities)

    def painted(self, grid: Grid, points: Floats) -> Floats:
        """OUTSIDE, WALL or BLOOD for each voxel (k,j,i), with the nodes at points (n,3), m."""
        image, unmoved = np.full(grid.shape, OUTSIDE), np.zeros((grid.shape[0], 2))
        index = grid.index(points)
        paint_inside(image, index, self.wall, WALL, unmoved)
        for cavity in self.cavities:
            corners = cavity.corners(index)
            paint_inside(image, corners, cavity.triangles % len(corners), BLOOD, unmoved)
        return image


def _mirrored(image: Floats, grid: Grid, parts: Parts, points: Floats) -> Iterator[tuple[str, float]]:
    """What a mistake may have mirrored, in words, and how well image and mesh agree without it."""
    painted = parts.painted(grid, points)
    for axes in (axes for count in (1, 2, 3) for axes in combinations(range(3), count)):
        indices, coordinates = (" and ".join(names[axis] for axis in axes) for names in ("ijk", "xyz"))
        reverse = np.flip(image, tuple(2 - axis for axis in axes))
        yield f"voxels in reverse along {indices}", agreement(reverse, painted)
        negated = np.where(np.isin(np.arange(3), axes), -points, points)
        if _overhang(grid, negated, 0.0).max() <= 0.0:
            yield f"the mesh's {coordinates} negated", agreement(image, parts.painted(grid, negated))


def _overhang(grid: Grid, points: Floats, margin: float) -> Floats:
    """By how many metres (2,3) points exceed the box, less the margin, at the first and last voxel of each axis."""
    index = grid.index(points)
    first, last = -0.5 - index.min(axis=0), index.max(axis=0) - (np.array(grid.size) - 0.5)
    overhang: Floats = np.stack([first, last]) * grid.spacing + margin
    return overhang


def _towards(grid: Grid, axis: int, side: int) -> str:
    direction = grid.direction[:, axis] * (1.0 if side else -1.0)
    nearest = int(np.abs(direction).argmax())
    return f"towards the {TOWARDS[nearest][int(direction[nearest] > 0.0)]}"


def _threshold(values: Floats) -> float:
    otsu = sitk.OtsuThresholdImageFilter()
    otsu.Execute(sitk.GetImageFromArray(values.astype(np.float32)[None]))
    return float(otsu.GetThreshold())


def _dice(a: NDArray[np.bool_], b: NDArray[np.bool_]) -> float:
    total = int(np.count_nonzero(a)) + int(np.count_nonzero(b))
    return 2.0 * int(np.count_nonzero(a & b)) / max(total, 1)

"""Conversions of segmentations: from and to closed surfaces of the wall, and to images of a whole beat.

The surface of a segmented wall is closed, with open cavities cut at the base, and names each triangle. Marching cubes
(Lewiner et al. 2003, doi 10.1080/10867651.2003.10487582; implemented in scikit-image) runs on the points up to the
plane of the base, above which one more layer is outside: so the base is flat, and its triangles are those that reach
into that layer. Without them the surface of the wall consists of three pieces: both endocardia and the epicardium.

Images of the segmentations of a beat show blood bright, muscle dark and everything else between, the same in every
slice. They leave out the difficulties of a real cine for registration: noise, fat, papillary muscles and the space
between slices. Above the plane of the valves nothing is heart; it lies half a slice above the last slice that shows the
heart in that frame, so it moves by whole slices.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.ndimage import distance_transform_edt, map_coordinates
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from heartfit.core.arrays import Floats, Integers, Names
from heartfit.core.errors import InputError
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.surface import LabelledSurface, enclosed_volume, euler_characteristic, neighbours
from heartfit.imaging.raster import paint_inside
from heartfit.imaging.segmentation.levels import Box
from heartfit.imaging.segmentation.stack import Mask, Segmentation, Stack
from heartfit.imaging.segmentation.wall import LevelSets, Shaping, box_level_sets, segmentation_level_sets
from heartfit.imaging.sequence import Grid, ImageSequence

LEFT_WALL_REACH = 1.4
"""Distance from the left cavity, over the usual thickness of the left wall, up to which wall is left ventricular."""
LID_VALUE = 1e3
"""Level above the base, in voxels; the larger, the nearer the lid lies to the plane of the base."""
MIN_LEVEL = 0.05
"""Smallest distance of the surface from a point, in voxels; nearer crossings make slivers."""
BLOOD_BRIGHTNESS, BACKGROUND_BRIGHTNESS = 1.0, 0.5
"""Brightness of blood and of everything outside the heart; that of muscle is 0."""
EDGE_WIDTH = 2e-3
"""Distance [m] from a surface at which its two sides have their own brightness."""
DEFAULT_SHAPING = Shaping()


def segment_surface(surface: LabelledSurface, grid: Grid) -> Segmentation:
    """Segment the voxels with centres inside a closed surface; flat valves close the cavities."""
    cavities = {}
    for part, name in (("lv_cavity", "lv_endo"), ("rv_cavity", "rv_endo")):
        cavity = Cavity.from_endocardium(surface, name)
        corners = cavity.corners(surface.points)
        cavities[part] = _inside_surface(grid, corners, cavity.triangles % len(corners))
    wall = (
        _inside_surface(grid, surface.points, surface.triangles)
        & ~cavities["lv_cavity"]
        & ~cavities["rv_cavity"]
    )
    left = wall & _near_left(wall, grid, **cavities)
    return Segmentation(grid, {**cavities, "lv_wall": left, "rv_wall": wall & ~left})


def _inside_surface(grid: Grid, points: Floats, triangles: np.ndarray) -> Mask:
    painted = np.zeros(grid.shape)
    paint_inside(painted, grid.index(points), triangles, 1.0, np.zeros((grid.shape[0], 2)))
    return painted > 0.0


def _near_left(wall: Mask, grid: Grid, lv_cavity: Mask, rv_cavity: Mask) -> Mask:
    """Mask of voxels within LEFT_WALL_REACH times the thickness of the left wall (twice its median depth)."""
    to_left, to_right = (
        distance_transform_edt(~cavity, sampling=grid.spacing[::-1]) for cavity in (lv_cavity, rv_cavity)
    )
    thickness = 2.0 * float(np.median(to_left[wall & (to_left < to_right)]))
    near: Mask = to_left < LEFT_WALL_REACH * thickness
    return near


def wall_surface(segmentation: Segmentation, shaping: Shaping = DEFAULT_SHAPING) -> LabelledSurface:
    """Closed surface of the wall in scanner coordinates [m].

    Raises InputError for slices that cannot be used, and where the surfaces of cavities and outside meet.
    """
    levels = segmentation_level_sets(segmentation, shaping)
    places, triangles = _march(levels.wall / shaping.spacing)
    top = levels.wall.shape[0] - 1
    lid = (places[triangles, 2] > top).any(axis=1)
    places[:, 2] = np.minimum(places[:, 2], top)
    pieces = _pieces(triangles[~lid])
    labels = np.full(len(triangles), "base", dtype="<U8")
    labels[~lid] = _surface_names(levels, places, triangles[~lid], pieces)
    points = levels.box.points(places)
    _require_no_tunnel(triangles)
    outwards = enclosed_volume(points, triangles) > 0.0
    return LabelledSurface(points, triangles if outwards else triangles[:, ::-1], labels)


def _require_no_tunnel(triangles: Integers) -> None:
    tunnels = 1 - euler_characteristic(triangles) // 2
    if tunnels:
        raise InputError(
            f"segmentation: {tunnels} tunnels go through the wall; expected none: "
            "fill the voxels that the parts enclose, or segment thinner slices"
        )


def _march(field: Floats) -> tuple[Floats, Integers]:
    """Zero surface of a function (h, v, u) in voxels: indices u, v, h of its points (n, 3) and triangles (k, 3)."""
    from skimage.measure import marching_cubes

    distinct = np.where(field < 0.0, -1.0, 1.0) * np.maximum(np.abs(field), MIN_LEVEL)
    padded = np.pad(distinct, ((0, 1), (0, 0), (0, 0)), constant_values=LID_VALUE)
    places, triangles, _, _ = marching_cubes(padded, 0.0, allow_degenerate=False)  # type: ignore[no-untyped-call]
    return places[:, ::-1].astype(float), triangles.astype(np.int64)


def _pieces(triangles: Integers) -> Integers:
    """Number (k,) of the connected piece of each triangle."""
    pairs, count = neighbours(triangles), len(triangles)
    graph = coo_matrix((np.ones(len(pairs)), pairs.T), shape=(count, count))
    pieces: Integers = connected_components(graph, directed=False)[1]
    return pieces


def _surface_names(levels: LevelSets, places: Floats, triangles: Integers, pieces: Integers) -> Names:
    """Names (k,) of triangles by the level set that is zero on their piece; InputError unless each has one piece."""
    fields = {"lv_endo": levels.left, "rv_endo": levels.right, "epi": levels.outside}
    sampled = np.array([map_coordinates(field, places.T[::-1], order=1) for field in fields.values()])
    names = [
        list(fields)[int(np.abs(sampled[:, np.unique(triangles[pieces == piece])]).mean(axis=1).argmin())]
        for piece in range(int(pieces.max()) + 1)
    ]
    for name in fields:
        if names.count(name) != 1:
            raise InputError(
                f"segmentation: the surface of {name} has {names.count(name)} pieces; expected one piece for each "
                "surface: close holes in the wall and remove stray voxels"
            )
    return np.array(names)[pieces]


def label_images(
    frames: Sequence[Segmentation], times: Floats, period: float, shaping: Shaping = DEFAULT_SHAPING
) -> ImageSequence:
    """Make images (p, h, v, u) of segmentations at the times (p,) [s] of a beat; the first is end diastole.

    Raises InputError, naming the frame, where its slices cannot be used.
    """
    stacks = _stacks(frames)
    valves = [shaping.base(stack, frames[0].grid) for stack in stacks]
    box = _box(stacks, frames[0].grid, max(valves), shaping)
    images = [
        _image(box_level_sets(replace(box, stack=stack), shaping), plane)
        for stack, plane in zip(stacks, valves, strict=True)
    ]
    return ImageSequence(box.image_grid(), np.array(images, np.float32), times, period)


def _stacks(frames: Sequence[Segmentation]) -> list[Stack]:
    """Stack of each frame, with slices numbered as in the first."""
    stacks = [Stack.from_segmentation(frames[0])]
    for number, frame in enumerate(frames[1:], start=1):
        try:
            stacks.append(Stack.from_segmentation(frame, stacks[0].step))
        except InputError as fault:
            raise InputError(f"frame {number}: {fault}") from None
    return stacks


def _box(stacks: Sequence[Stack], grid: Grid, top: float, shaping: Shaping) -> Box:
    """Box for all frames, slightly higher than the highest position of the valves."""
    deepest = max(len(stack.heart) for stack in stacks)
    heart = np.zeros((deepest, *grid.shape[1:]), bool)
    for stack in stacks:
        heart[: len(stack.heart)] |= stack.heart
    whole = Stack({"heart": heart}, stacks[0].first, stacks[0].step)
    above = top - (deepest - 1) * float(grid.spacing[2])
    return Box.around(whole, grid, shaping.spacing, shaping.right_wall, above + 2.0 * EDGE_WIDTH)


def _image(levels: LevelSets, valves: float) -> Floats:
    """Brightness (h, v, u), which changes within EDGE_WIDTH of a surface."""
    below = _inside_share(levels.box.heights - valves)[:, None, None]
    blood = below * _inside_share(np.minimum(levels.left, levels.right))
    return BACKGROUND_BRIGHTNESS * (1.0 - below * _inside_share(levels.outside)) + BLOOD_BRIGHTNESS * blood


def _inside_share(distance: Floats) -> Floats:
    return np.clip(0.5 - 0.5 * distance / EDGE_WIDTH, 0.0, 1.0)
